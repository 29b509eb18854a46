#include "algo/uncertainty/coverage.h"

#include <cmath>
#include <limits>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

// Upper tail of Student's t distribution: probability, quantile of the normal distribution, and two
// limits of the quantile for one or more degrees of freedom.
struct Tail {
  double probability, of_normal, below_all, above_all;
};
constexpr Tail kTwoSided = {0.025, 1.959963984540054, 1.9, 13};  // 12.71 for ν = 1
constexpr Tail kOneSided = {0.05, 1.6448536269514722, 1.6, 7};   // 6.31 for ν = 1
constexpr double kAlmostNormal = 1e7;  // for more degrees of freedom, k differs by less than 1e-6
                                       // from the normal distribution
constexpr double kManyFreedom = 200;
constexpr double kSettled = 1e-13;
constexpr int kMostSteps = 100;

// Quantile of Student's t distribution by an expansion in 1/ν (Cornish and Fisher; Abramowitz and
// Stegun 26.7.5). For 200 or more degrees of freedom the error is below 1e-8 of k. The expansion is
// fast; each point of a run needs five quantiles.
double by_expansion(double z, double freedom) {
  const double z2 = z * z;
  const double first = z * (z2 + 1) / 4;
  const double second = z * ((5 * z2 + 16) * z2 + 3) / 96;
  const double third = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  return z + (first + (second + third / freedom) / freedom) / freedom;
}

// Solves t_upper_tail(k) = probability by regula falsi (Illinois), which needs about a tenth of the
// steps of a bisection.
double quantile(double freedom, const Tail& tail) {
  if (!(freedom < kAlmostNormal)) return tail.of_normal;
  if (freedom >= kManyFreedom) return by_expansion(tail.of_normal, freedom);
  const auto excess = [&](double k) { return t_upper_tail(k, freedom) - tail.probability; };
  double low = tail.below_all, high = tail.above_all;
  while (excess(high) > 0) high *= 2;  // fewer than one degree of freedom
  double above = excess(low), below = excess(high);
  double k = low;
  for (int step = 0, side = 0; step < kMostSteps && high - low > kSettled * high; ++step) {
    k = (low * below - high * above) / (below - above);
    const double at = excess(k);
    if (at == 0) break;
    if (at > 0) {
      if (k - low < kSettled * k) break;
      low = k;
      above = at;
      if (side == 1) below /= 2;
      side = 1;
    } else {
      if (high - k < kSettled * k) break;
      high = k;
      below = at;
      if (side == -1) above /= 2;
      side = -1;
    }
  }
  return k;
}

}  // namespace

double fourth_over_freedom(double u_square, double freedom) {
  return u_square * u_square / freedom;
}

double effective_freedom(double sum_of_squares, double sum_of_fourths) {
  const double freedom = sum_of_squares * sum_of_squares / sum_of_fourths;
  return freedom < kAlmostNormal ? freedom : std::numeric_limits<double>::infinity();
}

double effective_freedom(std::span<const UncertaintyPart> parts) {
  double square = 0, fourth = 0;
  for (const UncertaintyPart& part : parts) {
    square += part.u * part.u;
    fourth += fourth_over_freedom(part.u * part.u, part.freedom);
  }
  return effective_freedom(square, fourth);
}

double coverage_factor(double freedom) {
  return quantile(freedom, kTwoSided);
}

double one_sided_factor(double freedom) {
  return quantile(freedom, kOneSided);
}

}  // namespace mdof::algo
