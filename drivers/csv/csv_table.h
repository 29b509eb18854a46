// A measured series as CSV, read whole: named columns of finite numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers {

struct CsvTable {
  std::string source;             // file name, for messages
  std::uint64_t header_line = 0;  // number of the line with the names
  bool simulated = false;         // a comment says so
  bool noise_only = false;        // of its u, likewise
  // In the order in which they were asked for, then the optional ones; of one of these that the
  // file does not have: empty.
  std::vector<std::vector<double>> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
  std::string where(std::size_t row) const;  // "file.csv:7: "
};

// The columns `names` of `path` ("-": standard input), plain or gzip, in any order among others;
// those of `optional` where they are there with a value in any row. Errors name file, line, column
// and remedy: what CsvRows refuses; no column of that name; one that has the name of an optional
// column but for its case or one letter ("Direction"), where that is not there; a cell without a
// value; a line that is none; more rows than `most_rows`. `descriptor`: of the file where it is
// open already (byte_source.h), -1: not.
inline constexpr std::size_t kMostTableRows = 10'000'000;  // all are in memory at once
Result<CsvTable> read_csv_table(const std::string& path, const std::vector<std::string>& names,
                                const std::vector<std::string>& optional = {},
                                std::size_t most_rows = kMostTableRows, int descriptor = -1);

}  // namespace mdof::drivers
