// Parses the rows of a probe log or a frames file into the columns of SampleBlocks. Pure: input and
// output are in memory. The blocks do not depend on how the text is divided into pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/csv/csv_stops.h"
#include "schema/base/number/number_columns.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/recording/probe_log.h"
#include "schema/sample.h"

namespace mdof {

// Number of readable bytes that must exist before and after a piece of text.
inline constexpr int kCsvMargin = 64;

struct CsvLimits {
  // Largest number of bad lines that are skipped and reported; one more bad line is an error. 0: no
  // line is skipped.
  std::size_t bad_lines = 100;
  // With this number, the columns of a block need about 0.5 MB, which fits into the cache of a
  // core.
  std::size_t scans_per_block = 8192;
  // Largest number of bytes of successive empty lines; more bytes are an error. Without this limit,
  // a gzip file of some MB could contain so many empty lines that reading takes hours.
  std::size_t blank_bytes = std::size_t{4} << 20;
};

// The values are raw, in the unit of the channel. All values are finite, except missing values (NaN
// with Quality::missing). A block has `scans_per_block` scans. The last block has fewer, and so has
// a block before a skipped line. `lost` of the next block is the number of skipped lines. A frames
// file has no time: time_ns is the row number, from 0.
class CsvRowParser {
 public:
  CsvRowParser(CsvHeader header, CsvLimits limits);

  // Passes the next piece of the file to the parser. A piece consists of complete lines that end in
  // LF; kCsvMargin bytes before and after the piece must be readable. The piece must remain valid
  // until next() returns false.
  void give(std::string_view lines);
  // Returns true if `block` is the next block; its memory is reused. Returns false if the parser
  // needs the next piece: call give(). Errors: too many bad or empty lines; time that does not
  // increase; a decimal comma. An error is final.
  Result<bool> next(SampleBlock& block);
  // Call this after the last piece. Returns true with the last, shorter block, or false if no rows
  // remain. Error: the file contains no good row.
  Result<bool> last(SampleBlock& block);

  const CsvHeader& header() const { return header_; }
  const std::vector<std::string>& bad_lines() const { return bad_lines_; }  // "file:line: reason"
  std::uint64_t rows() const { return rows_before_ + row_; }
  // One notice for each column with missing values: their number and the position of the first
  // missing value. The notices count only the blocks that were returned so far.
  Notices missing_values() const;

 private:
  void parse_plain_rows();
  std::size_t plain_rows_ahead(bool crlf) const;
  std::size_t read_columns(std::size_t rows, std::size_t stride);
  std::size_t skip_missing_fields(std::size_t channel, const ColumnText& column, std::size_t rows,
                                  std::size_t read);
  std::size_t read_times(std::size_t rows, std::size_t stride);
  Status parse_one_line();
  Status store(const struct CsvLine& line);
  Status count_blank_line(std::size_t bytes);
  Status report_blank_lines();
  Status report_bad(std::uint64_t line, const std::string& reason);
  std::string where(std::uint64_t line) const;
  void prepare_block();
  void deliver(SampleBlock& block);
  void mark_missing(std::size_t channel);

  CsvHeader header_;
  CsvLimits limits_;
  std::string plain_rows_, plain_crlf_rows_;  // value of CsvStops::byte for a batch of good rows
  std::string_view text_;
  CsvStops stops_;
  std::size_t next_stop_ = 0;  // index of the stop before the next line
  std::size_t begin_ = 0;      // start of the next line in text_
  std::uint64_t line_ = 0;     // number of the next line
  // Number of blank lines directly before the next line. At the end of a file they are ignored.
  std::uint64_t blank_lines_ = 0;
  std::size_t blank_bytes_ = 0;  // bytes of the blank lines
  // Current block; its columns have their full length, and row_ rows are filled.
  SampleBlock block_;
  std::size_t row_ = 0;
  bool block_ends_ = false;        // true: the block ends before a skipped line
  std::uint64_t lost_ = 0;         // number of lines that were skipped after the last good row
  std::uint64_t rows_before_ = 0;  // number of rows in the blocks that were returned
  std::int64_t last_time_ns_;
  std::vector<std::string> bad_lines_;
  struct Missing {
    bool in_block = false;  // true: block_ may contain missing values
    std::uint64_t values = 0;
    std::uint64_t first_row = 0;  // row number, from 1
    std::int64_t first_ns = 0;
  };
  std::vector<Missing> missing_;  // [channel]
};

}  // namespace mdof
