// Cuts a ByteSource into chunks of whole lines.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "drivers/csv/byte_source.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Whole lines, each ending in LF, with kCsvMargin readable bytes before and behind.
class LineChunk {
 public:
  std::string_view text() const { return text_; }
  // The bytes that were read from the source for this chunk. In contrast to text(), they lack the
  // beginning of the first line, which was read with the previous chunk, and contain the incomplete
  // last line.
  std::string_view read() const { return read_; }

 private:
  friend class LineReader;
  std::vector<char> storage_;
  std::string_view text_, read_;
};

class LineReader {
 public:
  // A chunk has up to `chunk_bytes` bytes; a longer line is an error.
  LineReader(ByteSource& source, std::size_t chunk_bytes);
  // Replaces `chunk`, reusing its memory; an empty text means the end. Adds LF to a last line
  // without LF.
  Status read(LineChunk& chunk);

 private:
  Result<std::size_t> fill(char* to, std::size_t capacity);

  ByteSource& source_;
  std::size_t chunk_bytes_;
  std::vector<char> carry_;  // incomplete line with which the next chunk begins
  bool ended_ = false;
};

}  // namespace mdof::drivers
