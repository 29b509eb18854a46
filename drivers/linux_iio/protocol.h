// Converts the readings of an AD7745 or AD7746 (Linux driver ad7746) to picofarads, and picofarads
// to the gap of a capacitance probe. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "drivers/sysfs/poller.h"

namespace mdof::drivers {

// The range of 8.192 pF has 24 bits. The scale in the driver's sysfs file is truncated to
// 0.000000488; this is an error of 0.06 %.
inline constexpr double kAd7746_pF_per_count = 8.192 / 16'777'216;
inline constexpr std::int64_t kAd7746LeastRaw = -8'388'608, kAd7746MostRaw = 8'388'607;

// `subtracted`: counts that the converter's internal capacitor (CAPDAC) has subtracted. They are
// calculated with the typical scale of this capacitor; the scale of a single chip may differ by
// some percent.
double ad7746_pF(std::int64_t raw, std::int64_t subtracted);

// Gap of a probe as a function of its capacitance: calculated from the area of the electrode, or
// interpolated in a measured table.
struct GapLaw {
  // Model: a guarded electrode of this area in front of a flat target, in vacuum, without edge
  // effects. gap = eps0 · area / (C - stray). In air the calculated gap is 0.06 % too small.
  double area_mm2 = 0;
  double stray_pF = 0;
  // Measured table [pF, µm], sorted by ascending pF, with linear interpolation. Empty: the model is
  // used.
  std::vector<std::array<double, 2>> table;
};
// Gap in µm. It gets Quality::over_range in two cases: the capacitance is outside the table (the
// value at the end of the table is returned), or C - stray is less than one count (NaN is
// returned).
SysfsReading gap_um(const GapLaw& law, double pF);
// As gap_um(), for a raw reading. A reading at an end of the converter's range is also over range.
SysfsReading ad7746_gap_um(const GapLaw& law, std::int64_t raw, std::int64_t subtracted);

}  // namespace mdof::drivers
