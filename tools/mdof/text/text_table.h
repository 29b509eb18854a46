// Aligned columns for people, and numbers as they are written in them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/output/wrapped.h"

namespace mdof::tools {

// Columns of numbers are set to the right, others to the left; a rule stands below the head.
class TextTable {
 public:
  // The first `keys` columns say which row it is.
  explicit TextTable(std::vector<std::string> head, std::size_t keys = 1);
  void add(std::vector<std::string> row);  // as many cells as the head has
  std::string text() const;                // lines, each with its end, as wide as they are
  // Where that is wider than `width`: the widest column of words is broken into lines; where that
  // does not suffice, blocks of columns one below the other, each beginning with the keys. Columns
  // without a word are then left out. A word wider than all of its block is broken, but no path.
  std::string text(std::size_t width) const;

 private:
  struct Column {
    std::size_t of = 0, width = 0, longest_word = 0;
    bool right = false, empty = false;
  };
  using Block = std::vector<Column>;

  Block columns() const;
  bool narrowed(Block& all, std::size_t width) const;  // to one block
  std::vector<Block> blocks(std::size_t width) const;
  std::string text_of(const Block& block) const;
  void append_row(std::string& out, const Block& block, std::size_t row) const;

  std::vector<std::vector<std::string>> rows_;  // the head first
  std::size_t keys_;
};

// Line ends and tabs of free text as spaces: a note cannot look like another row.
std::string one_line(std::string text);

// Never "-0.00"; a number too long for a column has an exponent; not finite: "-".
std::string fixed(double x, int decimals);
std::string in_mm(double x_m);      // 4 decimals
std::string in_um(double x_m);      // 4 decimals
std::string in_urad(double x_rad);  // 3 decimals
// GUM 7.2.6: to the place of the second significant digit of its uncertainty, u or U, which may be
// the number itself; as above, or with these decimals, where that is 0 or not known.
std::string to_place(double x, double u, int otherwise);
std::string um_to_place(double x_m, double u_m);
std::string urad_to_place(double x_rad, double u_rad);
// Both to the place of u, or of the column that they are in.
std::string um_with_u(double x_m, double u_m, double column_u_m = 0);
std::string urad_with_u(double x_rad, double u_rad, double column_u_rad = 0);
std::string with_u(double x, double u, int otherwise);
// The largest of a column, so that all its numbers have as many decimals; 0: one is below a fifth
// of it, and each has a place of its own.
double column_u(const std::vector<double>& u);
std::string with_u(const std::string& value, const std::string& u);  // "0.0584 ± 0.0021"
std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace mdof::tools
