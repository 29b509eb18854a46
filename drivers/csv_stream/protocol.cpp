#include "drivers/csv_stream/protocol.h"

#include <utility>

namespace mdof::drivers {
namespace {

constexpr std::int64_t kLongest_ns = 3'200'000'000'000'000'000;

std::string_view without_end(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  return line;
}

}  // namespace

CsvStreamProtocol::CsvStreamProtocol(std::string source, std::size_t bad_lines)
    : source_(std::move(source)), bad_lines_allowed_(bad_lines) {}

Status CsvStreamProtocol::give(std::string_view bytes, std::vector<CsvStreamRow>& rows) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    unfinished_ += bytes.substr(0, end);
    if (unfinished_.size() > kLongestLine)
      return bad_input(source_ + ":" + std::to_string(line_ + 1) + ": a line is longer than " +
                       std::to_string(kLongestLine) + " bytes; end each row with a newline");
    if (end == bytes.npos) return {};
    bytes.remove_prefix(end + 1);
    ++line_;
    MDOF_CHECK(take_line(without_end(std::exchange(unfinished_, "")), rows));
  }
  return {};
}

Status CsvStreamProtocol::take_line(std::string_view line, std::vector<CsvStreamRow>& rows) {
  if (!header_) return take_head(line);
  if (line.starts_with('#')) return {};
  if (line == header_line_) {
    restarted_ = true;
    last_time_ns_ = std::numeric_limits<std::int64_t>::min();
    return {};
  }
  return take_row(line, rows);
}

Status CsvStreamProtocol::take_head(std::string_view line) {
  head_.append(line).append("\n");
  if (head_.size() > kLongestLine)
    return bad_input(source_ + ": no header line in the first " + std::to_string(kLongestLine) +
                     " bytes; first send a header line such as time_s,encoder_mm,A_um");
  if (line.empty() || line.starts_with('#')) return {};
  MDOF_TRY(header_, parse_csv_header(head_, CsvKind::stream, source_));
  header_line_ = line;
  head_.clear();
  return {};
}

Status CsvStreamProtocol::take_row(std::string_view line, std::vector<CsvStreamRow>& rows) {
  CsvLine parsed = parse_csv_line(line, *header_);
  const std::string place = source_ + ":" + std::to_string(line_) + ": ";
  if (parsed.state == CsvLine::State::fatal) return bad_input(place + parsed.reason);
  if (parsed.state == CsvLine::State::blank) return skip(place + "empty line");
  if (parsed.state == CsvLine::State::bad) return skip(place + parsed.reason);
  if (parsed.time_ns > kLongest_ns || parsed.time_ns < -kLongest_ns)
    return skip(place + "column time_s: the time differs from 0 by more than 100 years");
  if (header_->time_column >= 0) {
    if (parsed.time_ns <= last_time_ns_)
      return bad_input(place + "column time_s: " + std::to_string(parsed.time_ns) + " ns follows " +
                       std::to_string(last_time_ns_) +
                       " ns; the time must increase from row to row; a script that restarts must "
                       "send its header line again");
    last_time_ns_ = parsed.time_ns;
  }
  rows.push_back({parsed.time_ns, std::move(parsed.values), std::exchange(lost_, 0),
                  std::exchange(restarted_, false)});
  return {};
}

Status CsvStreamProtocol::skip(const std::string& reason) {
  if (line_ - window_begin_ >= kBadLinesWindow) {
    window_begin_ = line_;
    bad_in_window_ = 0;
    reasons_.clear();
  }
  ++bad_, ++lost_, ++bad_in_window_;
  if (reasons_.size() < 3) reasons_.push_back(reason);
  if (bad_in_window_ <= bad_lines_allowed_) return {};
  std::string message = source_ + ": more than " + std::to_string(bad_lines_allowed_) + " of " +
                        std::to_string(kBadLinesWindow) +
                        " lines are bad; repair the script or the cable. The first bad lines:";
  for (const auto& first : reasons_) message += "\n  " + first;
  return bad_input(message);
}

}  // namespace mdof::drivers
