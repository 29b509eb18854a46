// Chunks of a recording. Most inputs of a fuzzer have a wrong checksum of the zstd frame.
// Therefore the input is also used as the content of a valid frame. If a block is decoded, it is
// encoded and decoded again and must be the same block.
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "schema/recording/chunk.h"

namespace {

using namespace mdof;

void round_trip(std::string_view bytes) {
  SampleBlock block, again;
  if (const auto read = decode_chunk(bytes, block); !read) {
    if (read.error().message.empty()) std::abort();
    return;
  }
  const auto written = encode_chunk(block);
  if (!written || !decode_chunk(*written, again)) std::abort();
  if (again.device != block.device || again.channels != block.channels ||
      again.time_ns != block.time_ns || again.value.size() != block.value.size())
    std::abort();
}

std::string packed(std::string_view inside) {
  std::string out = "MDC1";
  for (int k = 0; k < 4; ++k) out += static_cast<char>(inside.size() >> (8 * k));
  std::string frame(ZSTD_compressBound(inside.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), inside.data(), inside.size(), 1));
  return out + frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  round_trip(bytes);
  round_trip(packed(bytes));
  return 0;
}
