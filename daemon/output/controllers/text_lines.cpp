#include "daemon/output/controllers/text_lines.h"

#include <algorithm>

#include "schema/base/number/number.h"

namespace mdof::controllers {

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

std::optional<double> decimal_from(std::string_view word) {
  const bool plus = word.starts_with("+");
  if (plus) word.remove_prefix(1);
  if (word.find_first_not_of("-0123456789.") != word.npos || (plus && word.starts_with("-")))
    return std::nullopt;
  double x = 0;
  const char* const end = word.data() + word.size();
  return parse_double(word.data(), end, x) == end ? std::optional(x) : std::nullopt;
}

tl::unexpected<Error> wrong_at(const std::string& file, std::size_t line, const std::string& what) {
  return bad_input(file + ":" + std::to_string(line) + ": " + what);
}

const ControllerFile* find_file(const std::vector<ControllerFile>& files, std::string_view name) {
  const auto at = std::find_if(files.begin(), files.end(),
                               [&](const ControllerFile& file) { return file.name == name; });
  return at == files.end() ? nullptr : &*at;
}

}  // namespace mdof::controllers
