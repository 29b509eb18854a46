// CSV documents in memory: a header with units, then one row for each point.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::tools {

// Numbers have 17 significant digits; a program that reads them gets exactly the same double. An
// unknown value is an empty cell. A text with a comma, a quote or a line end is quoted (RFC 4180).
class CsvText {
 public:
  CsvText& cell(double x);
  CsvText& cell(long long n);
  CsvText& cell(std::string_view text);
  CsvText& cells(std::initializer_list<std::string_view> texts);
  CsvText& end_row();
  std::string take() { return std::move(text_); }

 private:
  void separate();
  std::string text_;
  bool begun_ = false;  // The current row has a cell.
};

// The lines before the header, such as "# SIMULATED: ..."
std::string csv_marks(const std::vector<std::string>& marks);

}  // namespace mdof::tools
