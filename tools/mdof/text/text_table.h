// Tables with aligned columns, and functions that format numbers for them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/output/wrapped.h"

namespace mdof::tools {

// A table as text. Columns of numbers are aligned to the right, other columns to the left. A
// horizontal line follows the titles of the columns.
class TextTable {
 public:
  // `head`: titles of the columns. The first `keys` columns identify a row.
  explicit TextTable(std::vector<std::string> head, std::size_t keys = 1);
  void add(std::vector<std::string> row);  // Must have one cell for each column.
  std::string text() const;                // The table without wrapping.
  // If the table is wider than `width`, wraps the text in the widest text column. If it is still
  // too wide, divides the columns into several tables, one below the other. Each of these begins
  // with the first `keys` columns; columns without text are omitted. A word that is wider than
  // `width` is divided, but a path is not.
  std::string text(std::size_t width) const;

 private:
  struct Column {
    std::size_t of = 0, width = 0, longest_word = 0;
    bool right = false, empty = false;
  };
  using Block = std::vector<Column>;

  Block columns() const;
  // Makes the columns narrower until all of them fit into `width`. False: this is not possible.
  bool narrowed(Block& all, std::size_t width) const;
  std::vector<Block> blocks(std::size_t width) const;
  std::string text_of(const Block& block) const;
  void append_row(std::string& out, const Block& block, std::size_t row) const;

  std::vector<std::vector<std::string>> rows_;  // The first row contains the titles.
  std::size_t keys_;
};

// Replaces line ends and tabs by spaces. Otherwise a text of the user could look like another row
// of a table.
std::string one_line(std::string text);

// Writes "0.00" instead of "-0.00". A number that is too long for a column is written with an
// exponent. A non-finite number is "-".
std::string fixed(double x, int decimals);
std::string in_mm(double x_m);      // 4 decimals
std::string in_um(double x_m);      // 4 decimals
std::string in_urad(double x_rad);  // 3 decimals
// Rounds x to the decimal place of the second significant digit of u (GUM 7.2.6); u is the
// uncertainty of x (u or U), or x itself. If u is 0 or unknown, to_place() writes `otherwise`
// decimals, and the other functions write as many as in_um() and in_urad().
std::string to_place(double x, double u, int otherwise);
std::string um_to_place(double x_m, double u_m);
std::string urad_to_place(double x_rad, double u_rad);
// Writes "x ± u". Rounds both numbers to the second significant digit of u, or of the common u of
// their column if this is not 0.
std::string um_with_u(double x_m, double u_m, double column_u_m = 0);
std::string urad_with_u(double x_rad, double u_rad, double column_u_rad = 0);
std::string with_u(double x, double u, int otherwise);
// The common u of a column: the largest u; all numbers of the column then have the same number of
// decimals. 0 if the smallest u is less than a fifth of the largest u; each number is then rounded
// to its own u.
double column_u(const std::vector<double>& u);
std::string with_u(const std::string& value, const std::string& u);  // "0.0584 ± 0.0021"
std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace mdof::tools
