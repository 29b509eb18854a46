#include "algo/points/over_range.h"

#include <cmath>

namespace mdof::algo {
namespace {

constexpr std::size_t kReadingsPerOverRange = 100;
constexpr double kNear = 6;  // distance in standard deviations of the other readings
constexpr double kBiasOfShare = 4;

}  // namespace

void OverRange::add(double reading_m) {
  ++count;
  has_unknown = has_unknown || std::isnan(reading_m);
  low_m = std::fmin(low_m, reading_m);
  high_m = std::fmax(high_m, reading_m);
}

bool OverRange::is_near(double mean_m, double spread_m) const {
  const double away_m = std::fmin(std::abs(low_m - mean_m), std::abs(high_m - mean_m));
  return has_unknown || !(away_m > kNear * spread_m);
}

bool is_saturated(const OverRange& over, std::size_t readings, double mean_m, double spread_m) {
  return over.count > 1 && kReadingsPerOverRange * over.count > readings &&
         over.is_near(mean_m, spread_m);
}

double u_with_over_range(double u_m, double mean_m, double sd_m, const OverRange& over,
                         std::size_t readings) {
  if (over.count == 0 || !over.is_near(mean_m, sd_m)) return u_m;
  const double share = static_cast<double>(over.count) / static_cast<double>(readings);
  return std::hypot(u_m, kBiasOfShare * share * sd_m);
}

}  // namespace mdof::algo
