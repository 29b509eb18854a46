// Divides a ByteSource into chunks of complete lines.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "drivers/csv/byte_source.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Complete lines; each line ends in LF. kCsvMargin bytes before and after the text can be read.
class LineChunk {
 public:
  std::string_view text() const { return text_; }
  // The bytes that were read from the source for this chunk. They differ from text() at both ends.
  // The beginning of the first line is missing, because it was read with the previous chunk. The
  // beginning of the next line is included.
  std::string_view read() const { return read_; }

 private:
  friend class LineReader;
  std::vector<char> storage_;
  std::string_view text_, read_;
};

class LineReader {
 public:
  // A chunk has at most `chunk_bytes` bytes. A longer line is an error.
  LineReader(ByteSource& source, std::size_t chunk_bytes);
  // Replaces the contents of `chunk` and reuses its memory. An empty text means the end of the
  // source. Adds LF if the last line of the source has none.
  Status read(LineChunk& chunk);

 private:
  Result<std::size_t> fill(char* to, std::size_t capacity);

  ByteSource& source_;
  std::size_t chunk_bytes_;
  std::vector<char> carry_;  // incomplete line; the next chunk begins with it
  bool ended_ = false;
};

}  // namespace mdof::drivers
