// A CSV file of measured values that is read completely into memory: named columns of finite
// numbers.
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
  bool simulated = false;         // true: a comment in the file states that the data are simulated
  bool noise_only = false;        // true: a comment in the file states that u contains noise only
  // The required columns in the requested order, then the optional columns. An optional column that
  // is missing in the file is empty.
  std::vector<std::vector<double>> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
  std::string where(std::size_t row) const;  // "file.csv:7: "
};

// Reads the columns `names` of `path` ("-": standard input), plain text or gzip. The columns may
// have any order in the file; other columns are ignored. A column of `optional` is read if it
// exists and at least one row has a value in it. `descriptor`: open file (byte_source.h), or -1.
// Errors name file, line, column and remedy: any error of CsvRows; a missing column; a column whose
// name differs only by case or by one letter from the name of a missing optional column
// ("Direction"); a cell without a value; an invalid line; more than `most_rows` rows.
inline constexpr std::size_t kMostTableRows = 10'000'000;  // all rows are in memory at once
Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& names,
                                const std::vector<std::string>& optional = {},
                                std::size_t most_rows = kMostTableRows, int descriptor = -1);

}  // namespace mdof::drivers
