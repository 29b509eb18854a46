#include "algo/uncertainty/coverage.h"

#include <cmath>
#include <limits>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kTail = 0.025;
constexpr double kNormal = 1.959963984540054;  // Φ⁻¹(0.975)
constexpr double kAlmostNormal = 1e7;          // degrees of freedom; k differs by less than 1e-6
constexpr double kSettled = 1e-13;
constexpr int kMostSteps = 100;

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

// The root of the tail's probability by regula falsi (Illinois), which never leaves its bracket: a
// tenth of the steps of a bisection, and every point of a run asks for five of them.
double coverage_factor(double freedom) {
  if (!(freedom < kAlmostNormal)) return kNormal;
  const auto excess = [&](double k) { return t_upper_tail(k, freedom) - kTail; };
  double low = 1.9, high = 13;  // t of infinitely many degrees of freedom is 1.96, of one 12.71
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

}  // namespace mdof::algo
