// For any CSV rows, parsing the whole text and parsing it in pieces must give the same rows and
// the same errors.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "schema/recording/csv_row_parser.h"

namespace {

using namespace mdof;

struct Rows {
  std::vector<std::int64_t> times;
  std::vector<std::vector<double>> values;
  std::vector<std::string> complaints;
  std::string error;
};

void take(const Result<bool>& got, const SampleBlock& block, Rows& rows) {
  if (!got) rows.error = got.error().message;
  if (!got || !*got) return;
  rows.times.insert(rows.times.end(), block.time_ns.begin(), block.time_ns.end());
  rows.values.resize(block.value.size());
  for (std::size_t c = 0; c < block.value.size(); ++c) {
    if (block.value[c].size() != block.scans()) std::abort();
    rows.values[c].insert(rows.values[c].end(), block.value[c].begin(), block.value[c].end());
  }
}

// Copies whole lines to a buffer that has the margins that the parser may read, and parses them.
Rows parsed(const CsvHeader& header, std::string_view lines, std::size_t piece) {
  CsvRowParser parser(header, {.bad_lines = 5, .scans_per_block = 16});
  Rows rows;
  SampleBlock block;
  while (!lines.empty() && rows.error.empty()) {
    const std::size_t end = lines.find('\n', std::min(piece, lines.size() - 1));
    const std::size_t n = end == std::string_view::npos ? lines.size() : end + 1;
    const std::string padded = std::string(kCsvMargin, ' ') + std::string(lines.substr(0, n)) +
                               std::string(kCsvMargin, ' ');
    lines.remove_prefix(n);
    parser.give(std::string_view(padded).substr(kCsvMargin, n));
    for (bool more = true; more && rows.error.empty();) {
      const auto got = parser.next(block);
      more = got && *got;
      take(got, block, rows);
    }
  }
  if (rows.error.empty()) take(parser.last(block), block, rows);
  rows.complaints = parser.bad_lines();
  return rows;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const auto kind = data[0] == 255 ? CsvKind::table : static_cast<CsvKind>(data[0] % 3);
  std::string text(reinterpret_cast<const char*>(data) + 2, size - 2);
  text += '\n';
  const auto header = parse_csv_header(text, kind, "fuzz.csv");
  if (!header) {
    if (header.error().message.empty()) std::abort();
    return 0;
  }
  const std::string_view lines = std::string_view(text).substr(header->bytes);
  const Rows whole = parsed(*header, lines, text.size()), cut = parsed(*header, lines, data[1]);
  if (whole.times != cut.times || whole.complaints != cut.complaints || whole.error != cut.error ||
      whole.values.size() != cut.values.size())
    std::abort();
  for (std::size_t c = 0; c < whole.values.size(); ++c)
    if (!same(whole.values[c], cut.values[c])) std::abort();
  return 0;
}
