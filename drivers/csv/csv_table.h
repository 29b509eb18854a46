// A measured series from a CSV file, read completely: named columns of finite numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers {

struct CsvTable {
  std::string source;             // file name, for messages
  std::uint64_t header_line = 0;  // line number of the column names
  bool simulated = false;         // a comment says so
  bool noise_only = false;        // a comment says that u contains noise only
  // Required columns in the requested order, then the optional columns; an optional column that is
  // missing in the file is empty.
  std::vector<std::vector<double>> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
  std::string where(std::size_t row) const;  // "file.csv:7: "
};

// Reads the columns `names` of `path` ("-": standard input), plain or gzip. Columns may have any
// order; other columns are ignored. A column of `optional` is read if it exists and has a value in
// any row. Errors name file, line, column and remedy: any error of CsvRows; a missing column; a
// column whose name differs from that of a missing optional column only by case or one letter
// ("Direction"); a cell without a value; an invalid line; more than `most_rows` rows. `descriptor`:
// of the open file (byte_source.h), or -1.
inline constexpr std::size_t kMostTableRows = 10'000'000;  // all rows are in memory at once
Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& names,
                                const std::vector<std::string>& optional = {},
                                std::size_t most_rows = kMostTableRows, int descriptor = -1);

}  // namespace mdof::drivers
