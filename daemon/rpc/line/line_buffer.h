// Divides received bytes into lines. Private header.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace mdof::rpc {

class LineBuffer {
 public:
  // `padding`: number of bytes after a line that its user may read.
  LineBuffer(std::size_t max_line_bytes, std::size_t padding);

  // The space for received bytes; empty only if the next line is too long. The call makes the
  // result of next() invalid.
  std::span<char> space();
  void received(std::size_t bytes) { end_ += bytes; }
  void discard() { begin_ = scanned_ = end_; }

  struct Line {
    std::string_view text;  // without LF or CR LF
    bool too_long = false;  // the rest of the line is unknown, so no other line can follow
  };
  bool has_line();  // whether the buffer contains a complete line, or a line that is too long
  std::optional<Line> next();  // valid until space()
  bool partial() { return begin_ < end_ && !has_line(); }

 private:
  std::size_t max_line_, capacity_;
  std::unique_ptr<char[]> bytes_;
  std::size_t begin_ = 0, end_ = 0;  // the bytes [begin_, end_) were not taken yet
  std::size_t scanned_ = 0;          // there is no LF in [begin_, scanned_)
};

}  // namespace mdof::rpc
