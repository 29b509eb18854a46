#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/csv_stream/protocol.h"

// The first byte is the size of the pieces into which the other bytes are divided. The pieces must
// not change the result.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers;
  if (size == 0) return 0;
  const std::size_t piece = std::size_t{data[0]} + 1;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  CsvStreamProtocol whole("fuzz", 3), pieces("fuzz", 3);
  std::vector<CsvStreamRow> rows, rows_of_pieces;
  const bool good = whole.give(text, rows).has_value();
  bool good_pieces = true;
  for (std::size_t at = 0; good_pieces && at < text.size(); at += piece)
    good_pieces = pieces.give(text.substr(at, piece), rows_of_pieces).has_value();
  if (good != good_pieces || rows.size() != rows_of_pieces.size()) std::abort();
  for (const auto& row : rows)
    if (row.values.size() != whole.header()->channels.size()) std::abort();
  return 0;
}
