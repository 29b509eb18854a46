#include "tools/mdof/text_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "schema/units.h"

namespace mdof::tools {
namespace {

constexpr const char* kGap = "  ";

// Characters, not bytes: of UTF-8 only continuation bytes begin with 10.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool is_number(const std::string& cell) {
  return cell.empty() || (cell.find_first_of("0123456789-+") == 0 &&
                          cell.find_first_not_of("0123456789-+.e ±") == std::string::npos);
}

std::string aligned(const std::string& cell, std::size_t to, bool right) {
  const std::string space(to - width(cell), ' ');
  return right ? space + cell : cell + space;
}

}  // namespace

TextTable::TextTable(std::vector<std::string> head) : rows_{std::move(head)} {}

void TextTable::add(std::vector<std::string> row) {
  assert(row.size() == rows_.front().size());
  rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> widths(columns);
  std::vector<bool> right(columns, rows_.size() > 1);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      widths[c] = std::max(widths[c], width(rows_[r][c]));
      right[c] = right[c] && (r == 0 || is_number(rows_[r][c]));
    }
  }
  std::string out;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::string line, rule;
    for (std::size_t c = 0; c < columns; ++c) {
      line += (c == 0 ? "" : kGap) + aligned(rows_[r][c], widths[c], right[c]);
      rule += (c == 0 ? "" : kGap) + std::string(widths[c], '-');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
    if (r == 0) out += rule + '\n';
  }
  return out;
}

std::string fixed(double x, int decimals) {
  if (!std::isfinite(x)) return "-";
  char text[400];  // the longest double has 309 digits before its point
  std::snprintf(text, sizeof text, "%.*f", decimals, x);
  return text;
}

std::string in_mm(double x_m) {
  return fixed(to_mm(x_m), 4);
}
std::string in_um(double x_m) {
  return fixed(to_um(x_m), 4);
}
std::string in_urad(double x_rad) {
  return fixed(to_urad(x_rad), 3);
}

std::string with_u(const std::string& value, const std::string& u) {
  return value == "-" ? value : value + " ± " + u;
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : separator) + word;
  return out;
}

}  // namespace mdof::tools
