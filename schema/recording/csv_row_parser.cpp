#include "schema/recording/csv_row_parser.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "schema/base/csv/csv_stops.h"
#include "schema/recording/csv_line.h"
#include "schema/units.h"

namespace mdof {
namespace {

static_assert(kCsvMargin >= kColumnMargin && kCsvMargin >= kStopsMargin);
constexpr std::size_t kBatchRows = 256;

// Returns the bytes that end the fields of a batch of good rows.
std::string row_stops(std::size_t columns, const std::string& line_end) {
  const std::string row = std::string(columns - 1, ',') + line_end;
  std::string rows;
  for (std::size_t i = 0; i < kBatchRows; ++i) rows += row;
  return rows;
}

std::string seconds(std::int64_t time_ns) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3f s", ns_to_s(time_ns));
  return text.data();
}

std::string_view field(const ColumnText& column, std::size_t row) {
  const std::uint32_t* const stop = column.stop + row * column.stride;
  return {column.text + (stop[0] + 1u), column.text + stop[1]};
}

}  // namespace

CsvRowParser::CsvRowParser(CsvHeader header, CsvLimits limits)
    : header_(std::move(header)),
      limits_(limits),
      line_(header_.lines + 1),
      last_time_ns_(std::numeric_limits<std::int64_t>::min()) {
  assert(limits_.scans_per_block > 0);
  missing_.resize(header_.channels.size());
  plain_rows_ = row_stops(header_.columns.size(), "\n");
  plain_crlf_rows_ = row_stops(header_.columns.size(), "\r\n");
  prepare_block();
}

void CsvRowParser::prepare_block() {
  block_.channels = header_.channels;
  block_.time_ns.resize(limits_.scans_per_block);
  block_.value.resize(header_.channels.size());
  for (std::vector<double>& column : block_.value) column.resize(limits_.scans_per_block);
  block_.quality.clear();
  block_.lost = 0;
}

void CsvRowParser::give(std::string_view lines) {
  assert(begin_ == text_.size() && (lines.empty() || lines.back() == '\n'));
  text_ = lines;
  begin_ = next_stop_ = 0;
  find_stops(lines, stops_);
}

Result<bool> CsvRowParser::next(SampleBlock& block) {
  while (begin_ < text_.size()) {
    parse_plain_rows();
    if (row_ < limits_.scans_per_block && begin_ < text_.size()) MDOF_CHECK(parse_one_line());
    if (row_ == limits_.scans_per_block || block_ends_) {
      deliver(block);
      return true;
    }
  }
  return false;
}

Result<bool> CsvRowParser::last(SampleBlock& block) {
  if (rows() == 0)
    return bad_input(header_.source +
                     (bad_lines_.empty()
                          ? ": has a header, but no rows; check that the recording was saved"
                          : ": has no valid row; the first bad line is: " + bad_lines_[0]));
  if (row_ == 0) return false;
  deliver(block);
  return true;
}

void CsvRowParser::deliver(SampleBlock& block) {
  block_.time_ns.resize(row_);
  for (std::vector<double>& column : block_.value) column.resize(row_);
  for (std::size_t channel = 0; channel < missing_.size(); ++channel)
    if (std::exchange(missing_[channel].in_block, false)) mark_missing(channel);
  std::swap(block, block_);
  rows_before_ += row_;
  row_ = 0;
  block_ends_ = false;
  prepare_block();
}

void CsvRowParser::mark_missing(std::size_t channel) {
  const std::vector<double>& value = block_.value[channel];
  Missing& missing = missing_[channel];
  for (std::size_t row = 0; row < row_; ++row) {
    if (!std::isnan(value[row])) continue;
    if (missing.values++ == 0) {
      missing.first_row = rows_before_ + row + 1;
      missing.first_ns = block_.time_ns[row];
    }
    block_.quality.resize(block_.channels.size());
    block_.quality[channel].resize(row_, Quality::good);
    block_.quality[channel][row] = Quality::missing;
  }
}

// Reads as many successive plain rows as possible. It reads one column after the other, in batches.
// Text and stops then stay in the fastest cache, and numbers of the same kind follow each other.
void CsvRowParser::parse_plain_rows() {
  if (blank_lines_) return;                // the next line first reports the blank lines
  if (header_.has_text_columns()) return;  // a field may be quoted
  const std::size_t columns = header_.columns.size();
  for (;;) {
    if (next_stop_ + columns + 1 >= stops_.count) return;
    const bool crlf = stops_.byte[next_stop_ + columns] == '\r';
    const std::size_t stride = columns + crlf;
    const std::size_t wanted = plain_rows_ahead(crlf);
    const std::size_t rows = read_times(read_columns(wanted, stride), stride);
    if (row_ == 0 && rows > 0) block_.lost = std::exchange(lost_, 0);
    row_ += rows;
    line_ += rows;
    next_stop_ += rows * stride;
    begin_ = stops_.at[next_stop_] + 1u;
    if (rows == 0 || rows < wanted) return;
  }
}

// Returns the number of the next lines that have the correct number of fields and end in LF (or CR
// LF, if `crlf`). The number is at most one batch, and at most the free space of the block.
std::size_t CsvRowParser::plain_rows_ahead(bool crlf) const {
  const std::string& plain = crlf ? plain_crlf_rows_ : plain_rows_;
  const std::size_t stride = plain.size() / kBatchRows;
  const std::size_t room = std::min(kBatchRows, limits_.scans_per_block - row_);
  const std::size_t most = std::min(room, (stops_.count - 1 - next_stop_) / stride);
  const char* const found = stops_.byte.get() + next_stop_ + 1;
  if (std::memcmp(found, plain.data(), most * stride) == 0) return most;
  const auto [odd, unused] = std::mismatch(found, found + most * stride, plain.data());
  return static_cast<std::size_t>(odd - found) / stride;
}

// Reads all channels of the next rows. Returns the number of rows before the first field that is
// not plain.
std::size_t CsvRowParser::read_columns(std::size_t rows, std::size_t stride) {
  for (std::size_t channel = 0; channel < header_.channels.size(); ++channel) {
    const std::uint32_t* stop = stops_.at.get() + next_stop_ + header_.channel_columns[channel];
    const ColumnText column{text_.data(), stop, stride};
    const std::size_t read = read_doubles(column, rows, block_.value[channel].data() + row_);
    rows = read == rows || !header_.may_be_missing(channel)
               ? read
               : skip_missing_fields(channel, column, rows, read);
  }
  return rows;
}

// Call it when `read` of `rows` rows were read and the next field is not a number. If a probe
// failed, its values are missing in many successive rows.
std::size_t CsvRowParser::skip_missing_fields(std::size_t channel, const ColumnText& column,
                                              std::size_t rows, std::size_t read) {
  double* const out = block_.value[channel].data() + row_;
  while (read < rows && is_missing_value(field(column, read))) {
    missing_[channel].in_block = true;
    out[read++] = kNaN;
    if (read == rows || is_missing_value(field(column, read))) continue;
    const ColumnText rest{column.text, column.stop + read * column.stride, column.stride};
    read += read_doubles(rest, rows - read, out + read);
  }
  return read;
}

// As read_columns(), for the times. Returns the number of rows before a time that does not
// increase.
std::size_t CsvRowParser::read_times(std::size_t rows, std::size_t stride) {
  std::int64_t* const out = block_.time_ns.data() + row_;
  if (header_.time_column < 0) {
    std::iota(out, out + rows, static_cast<std::int64_t>(this->rows()));
    return rows;
  }
  const std::uint32_t* stop =
      stops_.at.get() + next_stop_ + static_cast<std::size_t>(header_.time_column);
  rows = read_times_ns({text_.data(), stop, stride}, rows, out);
  for (std::size_t row = 0; row < rows; ++row) {
    if (out[row] <= last_time_ns_) return row;
    last_time_ns_ = out[row];
  }
  return rows;
}

// Parses the line at begin_. The line may have any form.
Status CsvRowParser::parse_one_line() {
  const std::size_t end = text_.find('\n', begin_);
  const std::string_view text = text_.substr(begin_, end - begin_);
  const Result<bool> between = is_between_rows(text, header_);
  if (!between) return bad_input(where(line_) + between.error().message);
  const CsvLine line = *between ? CsvLine() : parse_csv_line(text, header_);
  if (line.state == CsvLine::State::fatal) return bad_input(where(line_) + line.reason);
  if (line.state == CsvLine::State::blank) {
    MDOF_CHECK(count_blank_line(end + 1 - begin_));
  } else {
    MDOF_CHECK(report_blank_lines());
    if (block_ends_) return {};  // the line is parsed again after the block was returned
    if (line.state == CsvLine::State::bad) {
      MDOF_CHECK(report_bad(line_, line.reason));
    } else if (!*between) {
      MDOF_CHECK(store(line));
    }
  }
  ++line_;
  begin_ = end + 1;
  do ++next_stop_;
  while (stops_.at[next_stop_] != end);
  return {};
}

Status CsvRowParser::store(const CsvLine& line) {
  const std::int64_t time_ns =
      header_.time_column >= 0 ? line.time_ns : static_cast<std::int64_t>(rows());
  if (time_ns <= last_time_ns_) {
    const char* const what = time_ns == last_time_ns_ ? "does not change" : "decreases";
    return bad_input(where(line_) + "column time_s: the time " + what + " (" +
                     std::to_string(time_ns) + " ns follows " + std::to_string(last_time_ns_) +
                     " ns), but it must increase from row to row; split or repair the log");
  }
  if (row_ == 0) block_.lost = std::exchange(lost_, 0);
  block_.time_ns[row_] = last_time_ns_ = time_ns;
  for (std::size_t channel = 0; channel < line.values.size(); ++channel) {
    block_.value[channel][row_] = line.values[channel];
    missing_[channel].in_block |= std::isnan(line.values[channel]);
  }
  ++row_;
  return {};
}

Notices CsvRowParser::missing_values() const {
  Notices found;
  for (std::size_t channel = 0; channel < missing_.size(); ++channel) {
    const Missing& missing = missing_[channel];
    if (missing.values == 0) continue;
    const std::string first = header_.time_column < 0
                                  ? "in row " + std::to_string(missing.first_row)
                                  : "at " + seconds(missing.first_ns);
    found.push_back(
        notice(NoticeCode::log_values_missing,
               header_.source + ": column " + header_.columns[header_.channel_columns[channel]],
               {{"missing", missing.values}, {"rows", rows_before_}, {"first", first}}));
  }
  return found;
}

Status CsvRowParser::count_blank_line(std::size_t bytes) {
  ++blank_lines_;
  blank_bytes_ += bytes;
  if (blank_bytes_ <= limits_.blank_bytes) return {};
  const std::uint64_t first = line_ + 1 - blank_lines_;
  return bad_input(where(first) + "more than " + std::to_string(limits_.blank_bytes) +
                   " bytes of empty lines begin here (" + std::to_string(blank_lines_) +
                   " lines so far); delete the empty lines and all later lines, or record again");
}

// Reports the blank lines if they are not at the end of the file.
Status CsvRowParser::report_blank_lines() {
  blank_bytes_ = 0;
  for (; blank_lines_ > 0; --blank_lines_)
    MDOF_CHECK(report_bad(line_ - blank_lines_, "empty line"));
  return {};
}

Status CsvRowParser::report_bad(std::uint64_t line, const std::string& reason) {
  bad_lines_.push_back(where(line) + reason);
  if (limits_.bad_lines == 0)
    return bad_input(bad_lines_[0] +
                     "; repair the line, because no row of this file may be missing");
  if (bad_lines_.size() > limits_.bad_lines) {
    std::string message = header_.source + ": more than " + std::to_string(limits_.bad_lines) +
                          " bad lines; repair the file. The first bad lines:";
    for (std::size_t k = 0; k < bad_lines_.size() && k < 3; ++k) message += "\n  " + bad_lines_[k];
    return bad_input(message);
  }
  ++lost_;
  block_ends_ = row_ > 0;
  return {};
}

std::string CsvRowParser::where(std::uint64_t line) const {
  return header_.source + ":" + std::to_string(line) + ": ";
}

}  // namespace mdof
