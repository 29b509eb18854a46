#include "algo/sensitivity/statistics/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

constexpr std::array<double, 2> kPerUnit = {0x1p48, 0x1p40};
// The sum of 2^40 cells of this size has less than 127 bits.
constexpr double kLargestCell = 0x1p86;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Mean of u (power 0) or of u² (power 1) over n trials.
double average(const PowerSums& sums, std::size_t power, double n) {
  if (sums.lost[power]) return kNotKnown;
  return static_cast<double>(sums.sum[power]) / kPerUnit[power] / n;
}

// Fourth central moment divided by sd⁴. Every trial is assumed in the middle of its slice.
double kurtosis(const OrderedTrials& trials, const Moments& m) {
  double sum = 0;
  for (const OrderedTrials::Slice& s : trials.slices()) {
    const double z = ((s.from / 2 + s.to / 2) - m.mean) / m.sd;
    sum += static_cast<double>(s.count) * (z * z) * (z * z);
  }
  return sum / static_cast<double>(trials.size());
}

}  // namespace

void PowerSums::add(const CellSums& cell) {
  for (std::size_t k = 0; k < sum.size(); ++k) {
    const double scaled = cell.power[k] * kPerUnit[k];
    if (std::abs(scaled) < kLargestCell) {
      sum[k] += static_cast<Int128>(std::rint(scaled));
    } else {
      lost[k] = true;
    }
  }
}

void PowerSums::add(const PowerSums& other) {
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] += other.sum[k];
    lost[k] = lost[k] || other.lost[k];
  }
}

Moments moments_of(const PowerSums& sums, const OrderedTrials& trials, const OutputScale& scale) {
  if (trials.size() == 0) return {kNotKnown, kNotKnown, kNotKnown, kNotKnown};
  const auto n = static_cast<double>(trials.size());
  const double half = scale.width * (0.5 * kCoreBins), u = average(sums, 0, n);
  Moments m;
  m.mean = scale.low + half + half * u;
  if (m.mean < trials.min()) m.mean = trials.min();
  if (m.mean > trials.max()) m.mean = trials.max();
  if (trials.size() < 2) return {m.mean, kNotKnown, kNotKnown, kNotKnown};
  if (trials.min() == trials.max()) return m;
  const double variance = (average(sums, 1, n) - u * u) * (n / (n - 1));
  m.sd = half * std::sqrt(variance < 0 ? 0.0 : variance);
  m.mean_se = m.sd / std::sqrt(n);
  // Var(s²) = (μ4 - σ⁴ (n-3)/(n-1)) / n, and s = √s².
  const double of_variance = (kurtosis(trials, m) - (n - 3) / (n - 1)) / n;
  m.sd_se = m.sd * std::sqrt(of_variance < 0 ? 0.0 : of_variance) / 2;
  return m;
}

}  // namespace mdof::algo
