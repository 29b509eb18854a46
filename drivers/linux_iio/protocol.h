// Converts readings of an AD7745/AD7746 (Linux driver ad7746) to picofarads, and these to the gap
// of a capacitance probe. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/sysfs/poller.h"

namespace mdof::drivers {

// 8.192 pF in 24 bits. The driver's scale attribute is truncated to 0.000000488, which is an error
// of 0.06 %.
inline constexpr double kAd7746_pF_per_count = 8.192 / 16'777'216;
inline constexpr std::int64_t kAd7746LeastRaw = -8'388'608, kAd7746MostRaw = 8'388'607;

// `subtracted`: counts that the converter's capacitor (CAPDAC) has subtracted, calculated with its
// typical scale. Chips differ in this scale by some percent.
double ad7746_pF(std::int64_t raw, std::int64_t subtracted);

// Gap of a probe as a function of its capacitance: by electrode area or by a table.
struct GapLaw {
  // A guarded electrode of this area in front of a flat target, in vacuum, without edge effects:
  // gap = eps0 · area / (C - stray). In air the calculated gap is 0.06 % too small.
  double area_mm2 = 0;
  double stray_pF = 0;
  // Measured table [pF, µm]: pF ascending, linear interpolation.
  std::vector<std::array<double, 2>> table;
};
// In µm. Quality::over_range outside the table (the value at its end is used) and if C - stray is
// less than a count (NaN).
SysfsReading gap_um(const GapLaw& law, double pF);
// As gap_um() for a raw reading; also over range at the ends of the converter's range.
SysfsReading ad7746_gap_um(const GapLaw& law, std::int64_t raw, std::int64_t subtracted);

}  // namespace mdof::drivers
