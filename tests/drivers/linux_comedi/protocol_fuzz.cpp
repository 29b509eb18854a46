#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "drivers/linux_comedi/protocol.h"

// The input gives the width of the samples, the number of inputs and the length of the reads. The
// samples follow. The driver must return all whole scans of these bytes, and their voltages must
// be finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::linux_comedi;
  if (size < 3) return 0;
  const bool long_samples = (data[0] & 1) != 0;
  const std::size_t inputs = 1 + data[1] % 16, read = 1 + data[2];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 3, size - 3);
  CodeSplitter line(inputs, long_samples);
  std::vector<std::uint32_t> codes;
  for (std::size_t at = 0; at < bytes.size(); at += read) line.take(bytes.substr(at, read), codes);
  const std::size_t scan = inputs * (long_samples ? 4 : 2);
  if (codes.size() != bytes.size() / scan * inputs) std::abort();
  const Polynomial to_volts = nominal({-10, 10}, 65535);
  for (const std::uint32_t code : codes) {
    if (!long_samples && code > 65535) std::abort();
    if (!std::isfinite(volts(code, to_volts))) std::abort();
    if (code >= 65535 && !at_rail(code, 65535)) std::abort();
  }
  return 0;
}
