#include "drivers/csv/line_reader.h"

#include <algorithm>

#include "schema/recording/csv_row_parser.h"

namespace mdof::drivers {

LineReader::LineReader(ByteSource& source, std::size_t chunk_bytes)
    : source_(source), chunk_bytes_(chunk_bytes) {}

Result<std::size_t> LineReader::fill(char* to, std::size_t capacity) {
  std::size_t count = 0;
  while (count < capacity && !ended_) {
    MDOF_TRY(const std::size_t got, source_.read(to + count, capacity - count));
    count += got;
    ended_ = got == 0;
  }
  return count;
}

Status LineReader::read(LineChunk& chunk) {
  chunk.storage_.resize(chunk_bytes_ + 1 + 2 * kCsvMargin);
  char* const text = chunk.storage_.data() + kCsvMargin;
  std::copy(carry_.begin(), carry_.end(), text);
  MDOF_TRY(const std::size_t got, fill(text + carry_.size(), chunk_bytes_ - carry_.size()));
  chunk.read_ = {text + carry_.size(), got};
  std::size_t size = carry_.size() + got;
  carry_.clear();
  if (ended_) {
    if (size > 0 && text[size - 1] != '\n') text[size++] = '\n';
  } else {
    const std::size_t lines = std::string_view(text, size).rfind('\n') + 1;
    if (lines == 0)
      return bad_input(source_.name() + ": a line is longer than " + std::to_string(chunk_bytes_) +
                       " bytes, so this is not a CSV text file; check the name of the file");
    carry_.assign(text + lines, text + size);
    size = lines;
  }
  chunk.text_ = {text, size};
  return {};
}

}  // namespace mdof::drivers
