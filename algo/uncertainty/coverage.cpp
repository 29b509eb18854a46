#include "algo/uncertainty/coverage.h"

#include <cmath>
#include <limits>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kTail = 0.025;
constexpr double kNormal = 1.959963984540054;  // Φ⁻¹(0.975)
constexpr double kAlmostNormal = 1e7;          // degrees of freedom; k differs by less than 1e-6

}  // namespace

double effective_freedom(std::span<const UncertaintyPart> parts) {
  double square = 0, fourth = 0;
  for (const UncertaintyPart& part : parts) {
    const double u2 = part.u * part.u;
    square += u2;
    fourth += u2 * u2 / part.freedom;
  }
  return fourth > 0 ? square * square / fourth : std::numeric_limits<double>::infinity();
}

double coverage_factor(double freedom) {
  if (!(freedom < kAlmostNormal)) return kNormal;
  double low = 1, high = 13;  // t of one degree of freedom is 12.71
  while (high - low > 1e-12 * high) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (t_upper_tail(middle, freedom) > kTail ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace mdof::algo
