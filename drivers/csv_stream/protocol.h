// Parses received bytes into rows of a probe log (schema/recording/probe_log.h, CsvKind::stream).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/recording/csv_line.h"
#include "schema/recording/probe_log.h"

namespace mdof::drivers {

struct CsvStreamRow {
  std::int64_t time_ns = 0;    // value of time_s; 0 if the header has no time_s
  std::vector<double> values;  // one value for each channel; NaN: missing
  std::uint64_t lost = 0;      // number of skipped lines before this row
  bool restarted = false;  // true: the header came again before this row, and time_s starts again
};

// Pure; accepts any bytes. Thread-bound.
class CsvStreamProtocol {
 public:
  static constexpr std::size_t kLongestLine = 65'536;
  static constexpr std::uint64_t kBadLinesWindow = 10'000;  // lines

  // Skips up to `bad_lines` of 10,000 lines; one more bad line is an error. `source` appears in
  // messages.
  CsvStreamProtocol(std::string source, std::size_t bad_lines);

  // Appends the rows that are complete with `bytes`. An error is final; it is returned after the
  // rows that precede it. Errors: no header; too many bad lines; a line that is too long; time_s
  // that does not increase; a decimal comma.
  Status give(std::string_view bytes, std::vector<CsvStreamRow>& rows);

  const std::optional<CsvHeader>& header() const { return header_; }  // empty until it was received
  std::uint64_t bad_lines() const { return bad_; }
  // Texts "source:line: reason" for the first bad lines in the present window of 10,000 lines; at
  // most three texts.
  const std::vector<std::string>& bad_line_reasons() const { return reasons_; }

 private:
  Status take_line(std::string_view line, std::vector<CsvStreamRow>& rows);
  Status take_head(std::string_view line);
  Status take_row(std::string_view line, std::vector<CsvStreamRow>& rows);
  Status skip(const std::string& reason);

  std::string source_;
  std::size_t bad_lines_allowed_;
  std::string unfinished_;   // incomplete line
  std::string head_;         // comments and header
  std::string header_line_;  // the header line as it was received
  std::optional<CsvHeader> header_;
  std::uint64_t line_ = 0, bad_ = 0, window_begin_ = 0, lost_ = 0;
  std::size_t bad_in_window_ = 0;
  bool restarted_ = false;
  std::int64_t last_time_ns_ = std::numeric_limits<std::int64_t>::min();
  std::vector<std::string> reasons_;
};

}  // namespace mdof::drivers
