#include "tools/mdof/csv/csv_text.h"

#include <cmath>

#include "schema/base/number/number.h"

namespace mdof::tools {

void CsvText::separate() {
  if (begun_) text_ += ',';
  begun_ = true;
}

CsvText& CsvText::cell(double x) {
  separate();
  if (!std::isfinite(x)) return *this;
  char digits[kDouble17Size];
  text_.append(digits, write_double_17(digits, x + 0.0));  // converts -0 to 0
  return *this;
}

CsvText& CsvText::cell(long long n) {
  separate();
  text_ += std::to_string(n);
  return *this;
}

CsvText& CsvText::cell(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) text_.append(c == '"' ? 2 : 1, c);
  text_ += '"';
  return *this;
}

CsvText& CsvText::cells(std::initializer_list<std::string_view> texts) {
  for (const auto text : texts) cell(text);
  return *this;
}

CsvText& CsvText::end_row() {
  text_ += '\n';
  begun_ = false;
  return *this;
}

std::string csv_marks(const std::vector<std::string>& marks) {
  std::string lines;
  for (const std::string& mark : marks) lines += "# " + mark + "\n";
  return lines;
}

}  // namespace mdof::tools
