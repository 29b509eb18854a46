#include "tools/mdof/text/text_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "schema/base/number/uncertainty_digits.h"
#include "schema/units.h"
#include "tools/mdof/terminal.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kGap = "  ";
constexpr std::size_t kNarrowest = 24;  // smallest width of a wrapped text column
constexpr double kLongest = 1e9;        // numbers from this size have an exponent

bool is_number(const std::string& cell) {
  return cell.empty() || (cell.find_first_of("0123456789-+") == 0 &&
                          cell.find_first_not_of("0123456789-+.e ±") == std::string::npos);
}

std::string aligned(const std::string& cell, std::size_t to, bool right) {
  const std::size_t width = text_width(cell);
  const std::string space(to > width ? to - width : 0, ' ');
  return right ? space + cell : cell + space;
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    longest = std::max(longest, text_width(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return longest;
}

// If a word is longer than `width`, inserts a space after every `width` characters.
std::string divide_long_words(std::string_view text, std::size_t width) {
  std::string out;
  std::size_t used = 0;
  for (const char c : text) {
    const bool begins = (c & 0xC0) != 0x80;  // first byte of a UTF-8 character
    if (c == ' ') {
      used = 0;
    } else if (begins && ++used > width) {
      out += ' ';
      used = 1;
    }
    out += c;
  }
  return out;
}

// Divides a cell into lines. A path is not divided, so that the user can copy it.
std::vector<std::string> lines_of(const std::string& cell, std::size_t width) {
  const bool path = cell.find('/') != std::string::npos;
  std::vector<std::string> lines(1);
  for (const char c : wrapped(path ? cell : divide_long_words(cell, width), width))
    c == '\n' ? lines.emplace_back() : lines.back().append(1, c);
  return lines;
}

template <typename Block>
std::size_t total(const Block& block) {
  std::size_t sum = 0;
  for (const auto& column : block) sum += column.width + kGap.size();
  return sum == 0 ? 0 : sum - kGap.size();
}

}  // namespace

TextTable::TextTable(std::vector<std::string> head, std::size_t keys)
    : rows_{std::move(head)}, keys_(std::min(keys, rows_.front().size())) {}

void TextTable::add(std::vector<std::string> row) {
  assert(row.size() == rows_.front().size());
  for (std::string& cell : row) cell = one_line(std::move(cell));
  rows_.push_back(std::move(row));
}

TextTable::Block TextTable::columns() const {
  Block columns(rows_.front().size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c] = {c, 0, 0, rows_.size() > 1, rows_.size() > 1};
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      columns[c].longest_word = std::max(columns[c].longest_word, longest_word(rows_[r][c]));
      columns[c].width = std::max(columns[c].width, text_width(rows_[r][c]));
      columns[c].right = columns[c].right && (r == 0 || is_number(rows_[r][c]));
      columns[c].empty = columns[c].empty && (r == 0 || rows_[r][c].empty());
    }
  }
  return columns;
}

bool TextTable::narrowed(Block& all, std::size_t width) const {
  std::erase_if(all, [this](const Column& c) { return c.empty && c.of >= keys_; });
  const auto widest =
      std::max_element(all.begin(), all.end(), [](const Column& a, const Column& b) {
        return (a.right ? 0 : a.width) < (b.right ? 0 : b.width);
      });
  const std::size_t used = total(all);
  if (used <= width) return true;
  if (widest->right || used - width >= widest->width) return false;
  const std::size_t left = widest->width - (used - width);
  if (left < std::max(kNarrowest, widest->longest_word)) return false;
  widest->width = left;
  return true;
}

std::vector<TextTable::Block> TextTable::blocks(std::size_t width) const {
  const Block all = columns();
  if (total(all) <= width) return {all};
  if (Block one = all; narrowed(one, width)) return {one};
  const Block keys(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(keys_));
  const auto room_of = [width](const Block& block) {
    const std::size_t taken = total(block) + kGap.size();
    return width > taken ? width - taken : 0;
  };
  const std::size_t most = room_of(keys);  // width of a column that is alone beside the key columns
  std::vector<Block> blocks{keys};
  for (std::size_t c = keys_; c < all.size(); ++c) {
    Column column = all[c];
    if (column.empty) continue;
    const std::size_t least = std::max(kNarrowest, std::min(column.longest_word, most));
    const std::size_t room = room_of(blocks.back());
    const bool fits = column.width <= room || (!column.right && room >= least);
    if (!fits && blocks.back().size() > keys_) blocks.push_back(keys);
    if (!column.right)
      column.width = std::min(column.width, std::max(room_of(blocks.back()), kNarrowest));
    blocks.back().push_back(column);
  }
  return blocks;
}

// A text cell that is too wide continues on the next lines.
void TextTable::append_row(std::string& out, const Block& block, std::size_t row) const {
  std::vector<std::vector<std::string>> cells;
  std::size_t height = 1;
  for (const Column& column : block) {
    const std::string& cell = rows_[row][column.of];
    const bool whole = text_width(cell) <= column.width;
    cells.push_back(whole ? std::vector{cell} : lines_of(cell, column.width));
    height = std::max(height, cells.back().size());
  }
  for (std::size_t h = 0; h < height; ++h) {
    std::string line;
    for (std::size_t c = 0; c < block.size(); ++c) {
      if (c > 0) line += kGap;
      line += aligned(h < cells[c].size() ? cells[c][h] : "", block[c].width, block[c].right);
    }
    out += line.erase(line.find_last_not_of(' ') + 1) + '\n';
  }
}

std::string TextTable::text_of(const Block& block) const {
  std::string out, rule;
  for (const Column& column : block) {
    if (!rule.empty()) rule += kGap;
    rule.append(column.width, '-');
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    append_row(out, block, r);
    if (r == 0) out += rule + '\n';
  }
  return out;
}

std::string TextTable::text() const {
  return text_of(columns());
}

std::string TextTable::text(std::size_t width) const {
  std::string out;
  for (const Block& block : blocks(width)) out += (out.empty() ? "" : "\n") + text_of(block);
  return out;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return text;
}

std::string fixed(double x, int decimals) {
  if (!std::isfinite(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, std::abs(x) < kLongest ? "%.*f" : "%.*e", decimals, x);
  const std::string_view digits = text;
  const bool zero = digits.find_first_not_of("-0.") == std::string_view::npos;
  return text + (zero && text[0] == '-' ? 1 : 0);
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

std::string to_place(double x, double u, int otherwise) {
  if (!(u > 0) || !std::isfinite(u) || !std::isfinite(x)) return fixed(x, otherwise);
  const int decimals = uncertainty_decimals(u);
  return fixed(rounded_to_tens(x, decimals), std::max(0, decimals));
}

std::string um_to_place(double x_m, double u_m) {
  return to_place(to_um(x_m), to_um(u_m), 4);
}
std::string urad_to_place(double x_rad, double u_rad) {
  return to_place(to_urad(x_rad), to_urad(u_rad), 3);
}

std::string with_u(const std::string& value, const std::string& u) {
  return value == "-" ? value : value + " ± " + u;
}

std::string with_u(double x, double u, int otherwise) {
  return with_u(to_place(x, u, otherwise), to_place(u, u, otherwise));
}
std::string um_with_u(double x_m, double u_m, double column_u_m) {
  const double place_m = column_u_m > 0 ? column_u_m : u_m;
  return with_u(um_to_place(x_m, place_m), um_to_place(u_m, place_m));
}
std::string urad_with_u(double x_rad, double u_rad, double column_u_rad) {
  const double place_rad = column_u_rad > 0 ? column_u_rad : u_rad;
  return with_u(urad_to_place(x_rad, place_rad), urad_to_place(u_rad, place_rad));
}

double column_u(const std::vector<double>& u) {
  constexpr double kLeast = 0.2;
  if (u.empty()) return 0;
  const auto [least, most] = std::minmax_element(u.begin(), u.end());
  return *least >= kLeast * *most ? *most : 0;
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : separator) + word;
  return out;
}

}  // namespace mdof::tools
