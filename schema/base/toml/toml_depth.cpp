#include "schema/base/toml/toml_depth.h"

#include <algorithm>
#include <vector>

namespace mdof {
namespace {

// Reads a document in the same way as the parser. If the text is not TOML, the result may be wrong
// after the position at which the parser stops.
class DepthScan {
 public:
  DepthScan(std::string_view text, std::size_t bound) : text_(text), bound_(bound) {}

  std::optional<std::size_t> line_too_deep() {
    while (at_ < text_.size()) {
      take(text_[at_]);
      if (open_.size() + outer_dots_ + dots_ > bound_) return line_;
    }
    return std::nullopt;
  }

 private:
  void take(char c) {
    if (c == '#') return skip_comment();
    if (c == '"' || c == '\'') return skip_string(c);
    ++at_;
    if (c == '[' || c == '{') return open();
    if (c == ']' || c == '}') return close();
    if (c == '.') ++dots_;
    if (c == '\n') ++line_;
    if (c == ',' || (c == '\n' && open_.empty())) dots_ = 0;
  }

  // The contents of a bracket belong to the key before the bracket.
  void open() {
    open_.push_back(dots_);
    outer_dots_ += dots_;
    dots_ = 0;
  }

  void close() {
    if (open_.empty()) return;
    outer_dots_ -= open_.back();
    dots_ = open_.back();
    open_.pop_back();
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  bool is_next(std::string_view word) const { return text_.substr(at_, word.size()) == word; }

  void skip_string(char quote) {
    const std::string_view three = quote == '"' ? R"(""")" : "'''";
    if (!is_next(three)) return skip_to_end(text_.substr(at_, 1), quote == '"', "\n");
    skip_to_end(three, quote == '"', {});
    // Up to two more quotes belong to the text.
    for (int more = 0; more < 2 && is_next(three.substr(0, 1)); ++more) ++at_;
  }

  // Moves from the opening quotes to the end of the closing quotes; if they are missing, to `end`.
  void skip_to_end(std::string_view quotes, bool escapes, std::string_view end) {
    for (at_ += quotes.size(); at_ < text_.size() && !is_next(quotes); ++at_) {
      if (!end.empty() && is_next(end)) return;
      if (text_[at_] == '\n') ++line_;
      if (escapes && text_[at_] == '\\') skip_escaped();
    }
    // A text without closing quotes extends to the end.
    at_ = std::min(at_ + quotes.size(), text_.size());
  }

  void skip_escaped() {
    ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++line_;
  }

  std::string_view text_;
  std::size_t bound_;
  std::size_t at_ = 0, line_ = 1;
  // Number of dots in the current key; number of dots in the keys before all open brackets.
  std::size_t dots_ = 0, outer_dots_ = 0;
  std::vector<std::size_t> open_;  // number of dots before each open bracket
};

}  // namespace

std::optional<std::size_t> toml_line_over_depth(std::string_view text, std::size_t bound) {
  return DepthScan(text, bound).line_too_deep();
}

}  // namespace mdof
