// Parses rows of a probe log or a frames file into the columns of SampleBlocks. Pure: text in,
// blocks out. The blocks do not depend on how the text is divided into pieces.
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

inline constexpr int kCsvMargin = 64;  // bytes around a piece of text that must be readable

struct CsvLimits {
  // Number of lines that are skipped and reported; one more is an error. 0: none is skipped.
  std::size_t bad_lines = 100;
  // Half a megabyte of columns, which fits into the cache of a core.
  std::size_t scans_per_block = 8192;
  // Size of consecutive empty lines; one more is an error, because a gzip file of some MB may
  // contain hours of them.
  std::size_t blank_bytes = std::size_t{4} << 20;
};

// Values are raw, in the channel's unit. All are finite except missing ones (NaN, marked as
// Quality::missing). A block has `scans_per_block` scans; the last block, and a block that ends
// before a skipped line, has fewer. The `lost` of the next block counts the skipped lines. A frames
// file has no time: time_ns is the row number, from 0.
class CsvRowParser {
 public:
  CsvRowParser(CsvHeader header, CsvLimits limits);

  // Passes the next piece of the file: whole lines, each ending in LF, with kCsvMargin readable
  // bytes before and after. The piece must remain valid until next() returns false.
  void give(std::string_view lines);
  // True: `block` is the next block (its memory is reused). False: call give() first. Errors: too
  // many bad or empty lines, time that does not increase, a decimal comma. An error is final.
  Result<bool> next(SampleBlock& block);
  // After the last piece: true and the last, shorter block, or false. Error: no good row was found.
  Result<bool> last(SampleBlock& block);

  const CsvHeader& header() const { return header_; }
  const std::vector<std::string>& bad_lines() const { return bad_lines_; }  // "file:line: reason"
  std::uint64_t rows() const { return rows_before_ + row_; }
  // A notice for each column with missing values: their number and the position of the first.
  // Counts the blocks returned so far.
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
  std::string plain_rows_, plain_crlf_rows_;  // CsvStops::byte for a batch of good rows
  std::string_view text_;
  CsvStops stops_;
  std::size_t next_stop_ = 0;  // the stop before the next line
  std::size_t begin_ = 0;      // start of the next line in text_
  std::uint64_t line_ = 0;     // number of the next line
  // Number directly before the next line; at the end of a file they are ignored.
  std::uint64_t blank_lines_ = 0;
  std::size_t blank_bytes_ = 0;  // bytes of the blank lines
  SampleBlock block_;            // current block: columns at full length, row_ rows filled
  std::size_t row_ = 0;
  bool block_ends_ = false;        // the block ends before a skipped line
  std::uint64_t lost_ = 0;         // lines skipped since the last good row
  std::uint64_t rows_before_ = 0;  // rows in the blocks returned
  std::int64_t last_time_ns_;
  std::vector<std::string> bad_lines_;
  struct Missing {
    bool in_block = false;  // some values may be in block_
    std::uint64_t values = 0;
    std::uint64_t first_row = 0;  // from 1 on
    std::int64_t first_ns = 0;
  };
  std::vector<Missing> missing_;  // [channel]
};

}  // namespace mdof
