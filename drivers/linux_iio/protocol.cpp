#include "drivers/linux_iio/protocol.h"

#include <algorithm>
#include <cassert>

namespace mdof::drivers {
namespace {

// CODATA 2022: 8.8541878188e-12 F/m; 1 (pF/m) · mm² / pF = 1 µm.
constexpr double kEps0_pF_per_m = 8.8541878188;

SysfsReading from_table(const std::vector<std::array<double, 2>>& table, double pF) {
  if (!(pF >= table.front()[0])) return {table.front()[1], Quality::over_range};
  if (pF > table.back()[0]) return {table.back()[1], Quality::over_range};
  const auto above =
      std::upper_bound(table.begin() + 1, table.end() - 1, pF,
                       [](double x, const std::array<double, 2>& row) { return x < row[0]; });
  const auto& [x1, y1] = *above;
  const auto& [x0, y0] = *(above - 1);
  return {y0 + (y1 - y0) * ((pF - x0) / (x1 - x0)), Quality::good};
}

}  // namespace

double ad7746_pF(std::int64_t raw, std::int64_t subtracted) {
  return static_cast<double>(raw + subtracted) * kAd7746_pF_per_count;
}

SysfsReading gap_um(const GapLaw& law, double pF) {
  if (!law.table.empty()) return from_table(law.table, pF);
  assert(law.area_mm2 > 0);
  const double own_pF = pF - law.stray_pF;
  if (!(own_pF >= kAd7746_pF_per_count)) return {kNaN, Quality::over_range};
  return {kEps0_pF_per_m * law.area_mm2 / own_pF, Quality::good};
}

SysfsReading ad7746_gap_um(const GapLaw& law, std::int64_t raw, std::int64_t subtracted) {
  SysfsReading reading = gap_um(law, ad7746_pF(raw, subtracted));
  if (raw <= kAd7746LeastRaw || raw >= kAd7746MostRaw) reading.quality = Quality::over_range;
  return reading;
}

}  // namespace mdof::drivers
