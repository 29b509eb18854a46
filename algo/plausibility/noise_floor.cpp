#include "algo/plausibility/noise_floor.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

// Ratio of mean |second difference| to σ for white noise: √6 · √(2/π).
constexpr double kBendOfNoise = 1.9544;
// If σ is calculated from means over n values, its lower quartile is below the true σ by the share
// 0.72/√n. The factor was simulated for n = 4 to 50 and is accurate to 1 %.
constexpr double kQuartileBelow = 0.72;
constexpr int kBinsPerOctave = 8;
constexpr int kSmallestExponent = -49;  // 2^-50 m is 1e-15 m; smaller values count as 0

std::size_t bin_of(double sd, std::size_t bins) {
  int exponent = 0;
  const double mantissa = std::frexp(sd, &exponent);  // 0.5 ... 1
  if (!(sd > 0) || exponent < kSmallestExponent) return 0;
  const int bin = 1 + (exponent - kSmallestExponent) * kBinsPerOctave +
                  static_cast<int>((mantissa - 0.5) * 2 * kBinsPerOctave);
  return std::min(static_cast<std::size_t>(bin), bins - 1);
}

double middle_of(std::size_t bin) {
  if (bin == 0) return 0;
  const auto k = static_cast<int>(bin) - 1;
  const double mantissa = 0.5 + (k % kBinsPerOctave + 0.5) / (2.0 * kBinsPerOctave);
  return std::ldexp(mantissa, k / kBinsPerOctave + kSmallestExponent);
}

}  // namespace

void NoiseFloor::add(double mean_bend, std::size_t rows) {
  if (!std::isfinite(mean_bend) || rows == 0) return;
  const double quartile = 1 - kQuartileBelow / std::sqrt(static_cast<double>(rows));
  const std::size_t bin = bin_of(mean_bend / kBendOfNoise / quartile, kBins);
  ++slots_[bin];
  ++total_;
  below_ += bin < bin_;
  while (4 * below_ >= total_) below_ -= slots_[--bin_];
  while (4 * (below_ + slots_[bin_]) < total_) below_ += slots_[bin_++];
  sd_ = middle_of(bin_);
}

}  // namespace mdof::algo
