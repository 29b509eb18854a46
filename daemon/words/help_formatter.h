// Formats the help of a program to a number of columns. CLI11 does not break lines, and it counts
// bytes instead of characters. This code is in a header, because only programs that use CLI11
// include it.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "schema/base/output/wrapped.h"

namespace mdof::words {

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::size_t columns) : columns_(columns) {}

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return row(make_option_name(option, is_positional) + make_option_opts(option),
               make_option_desc(option), get_column_width());
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return row(command->get_display_name(true), command->get_description(), kCommandColumn);
  }
  std::string make_description(const CLI::App* app) const override {
    return fitted(CLI::Formatter::make_description(app), columns_, 0);
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return fitted(CLI::Formatter::make_usage(app, std::move(name)), columns_);
  }
  // Lines of examples are not wrapped, so that users can copy them.
  std::string make_footer(const CLI::App* app) const override {
    std::istringstream lines(paragraphs(CLI::Formatter::make_footer(app)));
    std::string out;
    for (std::string line; std::getline(lines, line);)
      out += (line.starts_with(' ') ? line : wrapped(line, columns_)) + "\n";
    return out;
  }

 private:
  // Length of the longest command, with two spaces before and after it.
  static constexpr std::size_t kCommandColumn = 20;

  std::string row(const std::string& name, const std::string& description,
                  std::size_t column) const {
    std::string head = fitted("  " + name, columns_, 4);
    if (description.empty()) return head + "\n";
    if (text_width("  " + name) + 2 > column)
      head += "\n" + std::string(column, ' ');
    else
      head.append(column - text_width(head), ' ');
    std::string lines;
    for (const char c : wrapped(description, columns_ - std::min(column, columns_ - 1)))
      lines += c == '\n' ? "\n" + std::string(column, ' ') : std::string(1, c);
    return head + lines + "\n";
  }

  // Joins lines of a paragraph that the source file has broken. Lines that begin with a space are
  // examples and stay.
  static std::string paragraphs(std::string_view text) {
    constexpr std::size_t kFullLineWidth = 60;  // a shorter line is the end of a paragraph
    std::string out;
    bool line_continues = false;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      const bool prose = !line.empty() && line.front() != ' ' && line.back() != ':';
      if (!out.empty()) out += line_continues && prose ? ' ' : '\n';
      out += line;
      line_continues = prose && text_width(line) >= kFullLineWidth;
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out.empty() ? out : out + "\n";
  }

  std::size_t columns_;
};

}  // namespace mdof::words
