#include "algo/uncertainty/mean_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algo/model/lane_sum.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMeans = 256;

// Autocovariance at this lag. The divisor is n, so that the sum of the sequence is positive.
double covariance_at(std::span<const double> x, std::size_t lag) {
  const double products =
      lane_sum(x.subspan(lag), [lag](const double* e) { return e[0] * *(e - lag); });
  return products / static_cast<double>(x.size());
}

// Variance of the mean of `x`, from the sum of the autocovariances.
double correlated_variance(std::span<const double> x) {
  const auto n = static_cast<double>(x.size());
  const double variance = covariance_at(x, 0);
  const double noise = variance * std::sqrt(2 / n);  // standard deviation of an autocovariance
                                                     // whose true value is 0
  double sum = -variance, before = 4 * variance;
  std::size_t window = 0;
  for (std::size_t lag = 0; window < x.size() / 4; lag += 2) {
    const double first = lag == 0 ? variance : covariance_at(x, lag);
    const double pair = std::min(before, first + covariance_at(x, lag + 1));
    if (lag > 0 && pair < noise) break;
    sum += 2 * pair;
    before = pair;
    window = lag + 1;
  }
  if (sum < variance) return variance / (n - 1);
  return sum / (n - static_cast<double>(2 * window + 1));
}

}  // namespace

double mean_uncertainty(std::span<const double> deviations, double sd) {
  const std::size_t n = deviations.size();
  if (n < 2) return 0;
  const std::size_t length = (n + kMeans - 1) / kMeans;
  std::array<double, kMeans> means;
  const std::size_t count = n / length;
  for (std::size_t j = 0; j < count; ++j) {
    const auto part = deviations.subspan(j * length, length);
    means[j] = lane_sum(part, [](const double* e) { return *e; }) / static_cast<double>(length);
  }
  const double independent = sd * sd / static_cast<double>(n);
  const double correlated = correlated_variance({means.data(), count});
  return std::sqrt(std::max(independent, correlated));
}

}  // namespace mdof::algo
