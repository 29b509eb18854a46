// From the readings of an AD7745/AD7746 (Linux driver ad7746) to picofarads, and from these to the
// gap of a capacitance probe. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/sysfs/poller.h"

namespace mdof::drivers {

// 8.192 pF in 24 bits. The driver's own scale attribute is this, cut to 0.000000488: 0.06 % off.
inline constexpr double kAd7746_pF_per_count = 8.192 / 16'777'216;
inline constexpr std::int64_t kAd7746LeastRaw = -8'388'608, kAd7746MostRaw = 8'388'607;

// `subtracted`: what the converter's own capacitor (CAPDAC) had taken off, in counts, by its
// typical scale, which no two chips share to better than some percent.
double ad7746_pF(std::int64_t raw, std::int64_t subtracted);

// Gap of a probe for its capacitance: one of the two.
struct GapLaw {
  // A guarded electrode of this area before a flat target, in vacuum, without edge effects:
  // gap = eps0 · area / (C - stray). Air makes the gap read 0.06 % small.
  double area_mm2 = 0;
  double stray_pF = 0;
  // Or measured: [pF, µm], pF ascending, straight lines between.
  std::vector<std::array<double, 2>> table;
};
// µm; over range beyond the table (its end is held), and where C - stray is
// less than a count (NaN).
SysfsReading gap_um(const GapLaw& law, double pF);
// The same for a raw reading; over range at the ends of the converter's range.
SysfsReading ad7746_gap_um(const GapLaw& law, std::int64_t raw, std::int64_t subtracted);

}  // namespace mdof::drivers
