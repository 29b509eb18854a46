// Tables with aligned columns, and the format of numbers in them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/output/wrapped.h"

namespace mdof::tools {

// Columns of numbers are aligned to the right, others to the left. A rule follows the head.
class TextTable {
 public:
  // The first `keys` columns identify the row.
  explicit TextTable(std::vector<std::string> head, std::size_t keys = 1);
  void add(std::vector<std::string> row);  // As many cells as the head has.
  std::string text() const;                // Lines with line ends, not wrapped.
  // If the table is wider than `width`, breaks the widest text column into lines. If this does not
  // suffice, splits the columns into blocks one below the other; each block begins with the keys,
  // and columns without text are left out. A word wider than its block is broken, but a path is
  // not.
  std::string text(std::size_t width) const;

 private:
  struct Column {
    std::size_t of = 0, width = 0, longest_word = 0;
    bool right = false, empty = false;
  };
  using Block = std::vector<Column>;

  Block columns() const;
  // Narrows all columns to one block, if possible.
  bool narrowed(Block& all, std::size_t width) const;
  std::vector<Block> blocks(std::size_t width) const;
  std::string text_of(const Block& block) const;
  void append_row(std::string& out, const Block& block, std::size_t row) const;

  std::vector<std::vector<std::string>> rows_;  // The head is the first row.
  std::size_t keys_;
};

// Replaces line ends and tabs of free text by spaces, so that a note cannot look like another row.
std::string one_line(std::string text);

// Never writes "-0.00". A number too long for a column has an exponent; a number that is not finite
// is "-".
std::string fixed(double x, int decimals);
std::string in_mm(double x_m);      // 4 decimals
std::string in_um(double x_m);      // 4 decimals
std::string in_urad(double x_rad);  // 3 decimals
// Rounds x to the place of the second significant digit of its uncertainty (GUM 7.2.6): u or U, or
// x itself. If u is 0 or unknown, x has the decimals of the functions above, or `otherwise`.
std::string to_place(double x, double u, int otherwise);
std::string um_to_place(double x_m, double u_m);
std::string urad_to_place(double x_rad, double u_rad);
// Rounds both numbers to the place of u, or of the u of their column.
std::string um_with_u(double x_m, double u_m, double column_u_m = 0);
std::string urad_with_u(double x_rad, double u_rad, double column_u_rad = 0);
std::string with_u(double x, double u, int otherwise);
// The largest u of a column, so that all its numbers have the same decimals. 0 if the smallest u is
// less than a fifth of the largest; each number is then rounded to its own u.
double column_u(const std::vector<double>& u);
std::string with_u(const std::string& value, const std::string& u);  // "0.0584 ± 0.0021"
std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace mdof::tools
