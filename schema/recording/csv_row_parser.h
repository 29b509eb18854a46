// Rows of a probe log or a frames file, from text to the columns of SampleBlocks. Pure: text in,
// blocks out; where the text is cut into pieces makes no difference to the blocks.
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

inline constexpr int kCsvMargin = 64;  // bytes that may be read around a piece of text

struct CsvLimits {
  std::size_t bad_lines = 100;         // skipped and reported; one more is an error. 0: none may be
  std::size_t scans_per_block = 8192;  // half a megabyte of columns: stays in a core's cache
  // Of empty lines that follow one another; one more is an error: a gzip file of some MB may hold
  // hours of them.
  std::size_t blank_bytes = std::size_t{4} << 20;
};

// Values are raw, in the channel's unit; all are finite but for the missing ones (NaN, marked as
// Quality::missing). A block has `scans_per_block` scans, but
// for the last and for one that ends before a skipped line; the next block's `lost` counts those
// lines. In a frames file, which has no time, time_ns is the row's number from 0 on.
class CsvRowParser {
 public:
  CsvRowParser(CsvHeader header, CsvLimits limits);

  // The next piece of the file: whole lines, each ending in LF, with kCsvMargin readable bytes
  // before and behind. It must stay until next() gave false.
  void give(std::string_view lines);
  // True: `block` is the next block (what it held is reused). False: give() more first.
  // Errors: too many bad or empty lines, time not growing, a decimal comma. Final.
  Result<bool> next(SampleBlock& block);
  // After the last piece: true and the last, shorter block, or false. Error: there was no good row.
  Result<bool> last(SampleBlock& block);

  const CsvHeader& header() const { return header_; }
  const std::vector<std::string>& bad_lines() const { return bad_lines_; }  // file:line: reason
  std::uint64_t rows() const { return rows_before_ + row_; }
  // A line for each column with missing values: how many, and where the first is. Of the blocks
  // passed on.
  Notices missing_values() const;

 private:
  void parse_plain_rows();
  std::size_t plain_rows_ahead(bool crlf) const;
  std::size_t read_columns(std::size_t rows, std::size_t stride);
  std::size_t read_past_missing(std::size_t channel, const ColumnText& column, std::size_t rows,
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
  std::string plain_rows_, plain_crlf_rows_;  // CsvStops::byte of a batch of good rows
  std::string_view text_;
  CsvStops stops_;
  std::size_t next_stop_ = 0;      // the one before the next line
  std::size_t begin_ = 0;          // of the next line in text_
  std::uint64_t line_ = 0;         // number of the next line
  std::uint64_t blank_lines_ = 0;  // just before it: at the end of a file they do not matter
  std::size_t blank_bytes_ = 0;    // of these
  SampleBlock block_;              // in the making: columns at full length, row_ rows filled
  std::size_t row_ = 0;
  bool block_ends_ = false;        // before a line that is skipped
  std::uint64_t lost_ = 0;         // lines skipped since the last good row
  std::uint64_t rows_before_ = 0;  // in the blocks passed on
  std::int64_t last_time_ns_;
  std::vector<std::string> bad_lines_;
  struct Missing {
    bool in_block = false;  // some may be in block_
    std::uint64_t values = 0;
    std::uint64_t first_row = 0;  // from 1 on
    std::int64_t first_ns = 0;
  };
  std::vector<Missing> missing_;  // [channel]
};

}  // namespace mdof
