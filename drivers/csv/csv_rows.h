// Reads a CSV file of the bench in blocks: first the header, then the rows in the order of the
// file.
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
  CsvLimits limits;                                // bad_lines = 0 if each line must give a row
  bool sha256 = true;                              // takes as long as parsing, on another core
  std::size_t chunk_bytes = std::size_t{1} << 18;  // does not change the result
  int descriptor = -1;  // read from its beginning instead of opening the path; owned by the caller
};

// Thread-bound except bytes(). If there is other work than parsing (hashing, unpacking, waiting for
// a pipe), it has one thread, "csv read", from open() to the end of the file or to the destructor.
// It needs a few MB of memory for a file of any length. Blocks depend neither on timing nor on
// chunk_bytes.
class CsvRows {
 public:
  // Opens `path` ("-": standard input) and parses its header. The first bytes show whether it is
  // gzip.
  static Result<std::unique_ptr<CsvRows>> open(const std::string& path,
                                               const CsvRowsOptions& options);
  ~CsvRows();

  const CsvHeader& header() const;
  // Replaces `block` (its memory is reused); empty if no row arrived within `timeout`. An error is
  // final and follows all rows before it.
  Result<ReadState> next(SampleBlock& block, std::chrono::milliseconds timeout);
  Result<ReadState> next(SampleBlock& block);  // waits without limit

  // SHA-256 of the stored bytes after the end; before, and without options.sha256: "".
  std::string sha256() const;
  // After the end or an error: one notice for each skipped line and for each column with missing
  // values. Before: empty.
  Notices notices() const;
  std::uint64_t bytes() const;        // stored bytes read so far
  std::uint64_t bytes_total() const;  // 0: not known

 private:
  class Reading;
  explicit CsvRows(std::unique_ptr<Reading> reading);
  std::unique_ptr<Reading> reading_;
};

}  // namespace mdof::drivers
