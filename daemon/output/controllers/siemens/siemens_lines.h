// Reads a compensation file of a SINUMERIK line by line. Comment lines are skipped.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/text_lines.h"

namespace mdof::controllers {

// The lines of one file, in order.
class SiemensLines {
 public:
  explicit SiemensLines(const ControllerFile& file)
      : name_(file.name), lines_(lines_of(file.text)) {}
  bool take(std::string_view line) {
    skip();
    if (at_ >= lines_.size() || lines_[at_] != line) return false;
    ++at_;
    return true;
  }
  // Reads a line "KEY=value" and returns its value. nullopt: the next line has another key.
  std::optional<std::string_view> value(const std::string& key) {
    skip();
    if (at_ >= lines_.size() || !lines_[at_].starts_with(key + "=")) return std::nullopt;
    return lines_[at_++].substr(key.size() + 1);
  }
  std::optional<double> number(const std::string& key) {
    const auto text = value(key);
    return text ? decimal_from(*text) : std::nullopt;
  }
  bool at_end() const { return at_ == lines_.size(); }
  tl::unexpected<Error> expected(const std::string& what) const {
    return wrong_at(name_, at_ + 1, what + " is expected");
  }

 private:
  void skip() {
    while (at_ < lines_.size() && lines_[at_].starts_with(";")) ++at_;
  }
  std::string name_;
  std::vector<std::string_view> lines_;
  std::size_t at_ = 0;
};

}  // namespace mdof::controllers
