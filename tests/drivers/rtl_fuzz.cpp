// For any input, a file .rtl is read or rejected with a reason. The readings must be finite, and
// the direction must be known.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/imported/rtl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto series = mdof::drivers::parse_rtl(text, "fuzz.rtl");
  if (!series) {
    if (series.error().message.empty()) std::abort();
    return 0;
  }
  for (const auto& reading : series->readings)
    if (!std::isfinite(reading.position_m) || !std::isfinite(reading.deviation) ||
        std::abs(reading.direction) != 1 || reading.run < 1)
      std::abort();
  return 0;
}
