// Cuts a ByteSource into pieces of whole lines.
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
  // What was read of the source for it: the text begins with what the chunk before had too much,
  // and lacks what goes to the next.
  std::string_view read() const { return read_; }

 private:
  friend class LineReader;
  std::vector<char> storage_;
  std::string_view text_, read_;
};

class LineReader {
 public:
  // Pieces are of up to `chunk_bytes`; a longer line is an error.
  LineReader(ByteSource& source, std::size_t chunk_bytes);
  // Replaces `chunk`, reusing its memory; an empty text is the end. A last line without LF gets
  // one.
  Status read(LineChunk& chunk);

 private:
  Result<std::size_t> fill(char* to, std::size_t capacity);

  ByteSource& source_;
  std::size_t chunk_bytes_;
  std::vector<char> carry_;  // the beginning of the line that the next piece starts with
  bool ended_ = false;
};

}  // namespace mdof::drivers
