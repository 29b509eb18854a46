// Parses one line of a CSV file. It accepts all tolerated forms and finds the reasons of errors,
// but it is slow. It is used only for lines that the fast loop of CsvRowParser cannot read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/recording/probe_log.h"

namespace mdof {

struct CsvLine {
  enum class State {
    good,
    blank,
    bad,   // the line is invalid and may be skipped; see `reason`
    fatal  // the whole file is invalid; see `reason`
  };
  State state = State::good;
  std::string reason;  // begins with the name of the column, if there is one; ends with the remedy
  std::int64_t time_ns = 0;    // valid if the header has a time column
  std::vector<double> values;  // [channel]; NaN: missing
};

// Whether a field means a missing value: the field is empty, or is nan in a form that some program
// writes. The field must have no outer spaces.
bool is_missing_value(std::string_view field);

// Whether a line between the rows contains no row: a comment, or the header of the file again.
// Error: another header, because the columns of the following rows are different.
Result<bool> is_between_rows(std::string_view line, const CsvHeader& header);

// `line`: without its line end. Spaces around a field, and one '+' before a number, are accepted.
CsvLine parse_csv_line(std::string_view line, const CsvHeader& header);

}  // namespace mdof
