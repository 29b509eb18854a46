#include "daemon/rpc/line/line_buffer.h"

#include <algorithm>
#include <cstring>

namespace mdof::rpc {

LineBuffer::LineBuffer(std::size_t max_line_bytes, std::size_t padding)
    : max_line_(max_line_bytes),
      capacity_(max_line_bytes + 2),  // CR LF
      bytes_(std::make_unique<char[]>(capacity_ + padding)) {}

std::span<char> LineBuffer::space() {
  std::memmove(bytes_.get(), bytes_.get() + begin_, end_ - begin_);
  scanned_ -= std::min(scanned_, begin_);
  end_ -= begin_;
  begin_ = 0;
  return {bytes_.get() + end_, capacity_ - end_};
}

bool LineBuffer::has_line() {
  scanned_ = std::max(scanned_, begin_);
  const char* found =
      static_cast<const char*>(std::memchr(bytes_.get() + scanned_, '\n', end_ - scanned_));
  scanned_ = found != nullptr ? static_cast<std::size_t>(found - bytes_.get()) : end_;
  return found != nullptr || end_ - begin_ == capacity_;
}

std::optional<LineBuffer::Line> LineBuffer::next() {
  if (!has_line()) return std::nullopt;
  Line line{{bytes_.get() + begin_, scanned_ - begin_}};
  if (line.text.ends_with('\r')) line.text.remove_suffix(1);
  line.too_long = line.text.size() > max_line_;
  begin_ = std::min(scanned_ + 1, end_);
  return line;
}

}  // namespace mdof::rpc
