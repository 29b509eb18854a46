#include "algo/uncertainty/statistics/range_interval.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mdof::algo {
namespace {

constexpr int kInversionSteps = 5;  // the error of U by the iteration is then below 1 % of U

double value_at_95_percent(std::vector<double> off) {
  const auto at = off.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(off.size()));
  std::nth_element(off.begin(), at, off.end());
  return *at;
}

}  // namespace

RangeTrials::RangeTrials(std::vector<double> measured, std::vector<double> changes)
    : measured_(std::move(measured)),
      changes_(std::move(changes)),
      lowest_(*std::min_element(measured_.begin(), measured_.end())),
      highest_(*std::max_element(measured_.begin(), measured_.end())) {}

std::vector<double> RangeTrials::ranges(double cut) const {
  const std::size_t n = measured_.size();
  std::vector<double> truth = measured_;
  for (double& v : truth)
    v = std::min(std::max(v, std::min(lowest_ + cut, highest_)), highest_ - cut);
  std::vector<double> all(changes_.size() / n);
  for (std::size_t t = 0; t < all.size(); ++t) {
    const double* change = changes_.data() + t * n;
    double low = truth[0] + change[0], high = low;
    for (std::size_t i = 1; i < n; ++i) {
      const double v = truth[i] + change[i];
      low = std::min(low, v);
      high = std::max(high, v);
    }
    all[t] = high - low;
  }
  return all;
}

double RangeTrials::distance_at_95_percent(double true_range) const {
  std::vector<double> off = ranges((highest_ - lowest_ - true_range) / 2);
  for (double& v : off) v = std::abs(v - true_range);
  return value_at_95_percent(std::move(off));
}

double RangeTrials::end_distance() const {
  const std::size_t n = measured_.size();
  const auto [least, most] = std::minmax_element(measured_.begin(), measured_.end());
  const auto low = static_cast<std::size_t>(least - measured_.begin());
  const auto high = static_cast<std::size_t>(most - measured_.begin());
  std::vector<double> off(changes_.size() / n);
  for (std::size_t t = 0; t < off.size(); ++t)
    off[t] = std::abs(changes_[t * n + high] - changes_[t * n + low]);
  return value_at_95_percent(std::move(off));
}

// Solves c(R - U) = U by regula falsi (Illinois). c(T) decreases slowly with T.
double RangeTrials::U() const {
  const double range = highest_ - lowest_;
  const double most = distance_at_95_percent(0);
  if (most >= range) return most;
  const double as_measured = distance_at_95_percent(range);
  const auto excess = [&](double U) { return distance_at_95_percent(range - U) - U; };
  double low = 0, high = most;
  double below = as_measured, above = excess(high);
  if (above >= 0) return most + above;
  for (int step = 0, side = 0; step < kInversionSteps && below > 0; ++step) {
    const double U = (low * above - high * below) / (above - below);
    const double at = excess(U);
    if (at > 0) {
      low = U;
      below = at;
      if (side == 1) above /= 2;
      side = 1;
    } else {
      high = U;
      above = at;
      if (side == -1) below /= 2;
      side = -1;
    }
  }
  return std::max({high, as_measured, end_distance()});
}

double RangeTrials::standard_deviation() const {
  const std::vector<double> all = ranges(0);
  double mean = 0, square = 0;
  for (const double v : all) mean += v / static_cast<double>(all.size());
  for (const double v : all) square += (v - mean) * (v - mean);
  return std::sqrt(square / std::max(1.0, static_cast<double>(all.size()) - 1));
}

double RangeTrials::root_mean_square(double true_range) const {
  const std::vector<double> all = ranges((highest_ - lowest_ - true_range) / 2);
  double square = 0;
  for (const double v : all) square += std::pow(v - true_range, 2);
  return std::sqrt(square / static_cast<double>(all.size()));
}

}  // namespace mdof::algo
