// Reads a CSV file of the bench in blocks: header first, then rows in the order of the file.
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
  CsvLimits limits;                                // bad_lines = 0 where rows must map one to one
  bool sha256 = true;                              // costs as much time as parsing, on another core
  std::size_t chunk_bytes = std::size_t{1} << 18;  // no effect on what comes out
  int descriptor = -1;  // read from its beginning instead of opening the path; the caller's
};

// Thread-bound but for bytes(). Where there is something to be done beside parsing (hashing,
// unpacking, waiting for a pipe) it has one thread of its own, "csv read", from open() to the end
// of the file or to the destructor. Memory stays at some MB whatever the file's length. Blocks do
// not depend on timing or on chunk_bytes.
class CsvRows {
 public:
  // Opens `path` ("-": standard input), plain or gzip by its first bytes, and parses its header.
  static Result<std::unique_ptr<CsvRows>> open(const std::string& path,
                                               const CsvRowsOptions& options);
  ~CsvRows();

  const CsvHeader& header() const;
  // Replaces `block` (its memory is reused); empty where nothing came within `timeout`. An error is
  // final, and comes after all rows before it.
  Result<ReadState> next(SampleBlock& block, std::chrono::milliseconds timeout);
  Result<ReadState> next(SampleBlock& block);  // waits as long as it takes

  // After the end, else empty. Of the bytes as stored; also empty without options.sha256.
  std::string sha256() const;
  // After the end or an error, else empty: one line of text for each line skipped, and for
  // each column with missing values.
  Notices notices() const;
  std::uint64_t bytes() const;        // stored bytes read so far
  std::uint64_t bytes_total() const;  // 0: not known

 private:
  class Reading;
  explicit CsvRows(std::unique_ptr<Reading> reading);
  std::unique_ptr<Reading> reading_;
};

}  // namespace mdof::drivers
