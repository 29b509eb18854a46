// One line of a CSV file, slowly: every tolerance and every reason. Only lines that the fast loop
// of CsvRowParser does not understand come here.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/recording/probe_log.h"

namespace mdof {

struct CsvLine {
  enum class State {
    good,
    blank,
    bad,   // `reason`: the line may be skipped
    fatal  // `reason`: the whole file is not what it should be
  };
  State state = State::good;
  std::string reason;          // begins with the column where it has one; ends with the remedy
  std::int64_t time_ns = 0;    // where the header has a time column
  std::vector<double> values;  // [channel]; NaN: missing
};

// Whether a field without spaces says that there is no value: empty, or nan as programs write it.
bool is_missing_value(std::string_view field);

// `line` without its line end. Spaces around a field and one '+' before a number are tolerated.
CsvLine parse_csv_line(std::string_view line, const CsvHeader& header);

}  // namespace mdof
