// Parses one line of a CSV file slowly, with all tolerated forms and reasons for errors. Used only
// for lines that the fast loop of CsvRowParser cannot read.
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
    bad,   // the line may be skipped, see `reason`
    fatal  // the file is invalid, see `reason`
  };
  State state = State::good;
  std::string reason;          // begins with the column, if it concerns one; ends with the remedy
  std::int64_t time_ns = 0;    // if the header has a time column
  std::vector<double> values;  // [channel]; NaN: missing
};

// Whether a field without spaces is a missing value: empty, or nan in the notation of any program.
bool is_missing_value(std::string_view field);

// `line` is without its line end. Spaces around a field and one '+' before a number are accepted.
CsvLine parse_csv_line(std::string_view line, const CsvHeader& header);

}  // namespace mdof
