#include "algo/points/over_range.h"

#include <cmath>

namespace mdof::algo {
namespace {

constexpr std::size_t kOneOf = 100;
constexpr double kBiasOfShare = 4;

}  // namespace

bool is_saturated(std::size_t over_range, std::size_t readings) {
  return over_range > 1 && kOneOf * over_range > readings;
}

double with_over_range(double u_m, double sd_m, std::size_t over_range, std::size_t readings) {
  if (over_range == 0) return u_m;
  const double share = static_cast<double>(over_range) / static_cast<double>(readings);
  return std::hypot(u_m, kBiasOfShare * share * sd_m);
}

}  // namespace mdof::algo
