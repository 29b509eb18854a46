#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "drivers/linux_iio/protocol.h"

// The input is the raw value, the subtracted counts and the stray capacitance. A reading must not
// be infinite. If it is NaN, its quality must be over_range.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof;
  struct {
    std::int32_t raw, subtracted;
    double stray_pF;
  } in{};
  if (size < sizeof in) return 0;
  std::memcpy(&in, data, sizeof in);
  if (!std::isfinite(in.stray_pF)) return 0;
  const drivers::GapLaw plate{10, in.stray_pF, {}}, table{0, 0, {{1, 90}, {2, 45}, {3, 30}}};
  for (const auto& law : {plate, table}) {
    const auto reading = drivers::ad7746_gap_um(law, in.raw, in.subtracted);
    if (std::isinf(reading.value)) std::abort();
    if (std::isnan(reading.value) && reading.quality != Quality::over_range) std::abort();
  }
  return 0;
}
