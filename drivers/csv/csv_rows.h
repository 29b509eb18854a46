// Reads a CSV file of mdof in blocks: first the header, then the rows in the order of the file.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/recording/csv_row_parser.h"
#include "schema/recording/probe_log.h"
#include "schema/sample.h"

namespace mdof::drivers {

struct CsvRowsOptions {
  CsvKind kind = CsvKind::probe_log;
  CsvLimits limits;  // bad_lines = 0: every line must be a valid row
  // hashing takes as much time as parsing, on another core
  bool sha256 = true;
  std::size_t chunk_bytes = std::size_t{1} << 18;  // has no effect on the result
  // Open file, which is read from its beginning instead of `path`; the caller owns it.
  int descriptor = -1;
};

// Thread-bound except bytes(). If the object must also hash, unpack or wait for a pipe, it has a
// thread for this, "csv read", from open() to the end of the file or to the destructor. It needs a
// few MB of memory for a file of any size. The contents of the blocks do not depend on timing or on
// chunk_bytes.
class CsvRows {
 public:
  // Opens `path` ("-": standard input) and parses its header. Detects gzip data by the first bytes.
  static Result<std::unique_ptr<CsvRows>> open(const std::string& path,
                                               const CsvRowsOptions& options);
  ~CsvRows();

  const CsvHeader& header() const;
  // Replaces the contents of `block` and reuses its memory. The block is empty if no row arrived
  // within `timeout`. An error is final; it is returned after all rows that precede it.
  Result<ReadState> next(SampleBlock& block, std::chrono::milliseconds timeout);
  Result<ReadState> next(SampleBlock& block);  // waits without limit

  // SHA-256 of the stored file. "" before the end of the file was read, and without options.sha256.
  std::string sha256() const;
  // After the end or an error: one notice for each skipped line and for each column with missing
  // values. Before that: empty.
  Notices notices() const;
  std::uint64_t bytes() const;        // number of bytes read from the file so far
  std::uint64_t bytes_total() const;  // size of the file; 0: not known

 private:
  class Reading;
  explicit CsvRows(std::unique_ptr<Reading> reading);
  std::unique_ptr<Reading> reading_;
};

}  // namespace mdof::drivers
