#include "algo/on_the_fly/bin_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algo/points/median.h"
#include "algo/uncertainty/mean_uncertainty.h"

namespace mdof::algo {
namespace {

constexpr double kReject = 8.0, kStrictFactor = 12.0, kMadToSd = 1.4826;
constexpr std::size_t kNeighbours = 5;
// Factor for the distances of the first and the last readings from the median of their neighbours.
// These readings have neighbours on one side only, so the distances also contain the curvature.
constexpr double kEndReadingFactor = 0.5;
constexpr std::size_t kUnknowns = 3;

// Returns the slope between the medians of the two halves. A few spikes do not change the medians.
double robust_slope(std::span<const double> place, std::span<const double> reading) {
  const std::size_t half = place.size() / 2;
  const auto middle = [](std::span<const double> x) {
    return median_of(std::vector<double>(x.begin(), x.end()));
  };
  const double way = middle(place.subspan(half)) - middle(place.first(half));
  if (way == 0) return 0;
  return (middle(reading.subspan(half)) - middle(reading.first(half))) / way;
}

// Returns the distance of each reading from the median of its neighbours after subtraction of the
// slope.
std::vector<double> deviations_of(std::span<const double> place, std::span<const double> reading) {
  const double slope = robust_slope(place, reading);
  std::vector<double> level(reading.size()), out(reading.size());
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = reading[i] - slope * place[i];
  for (std::size_t i = 0; i < level.size(); ++i) {
    const std::size_t last = level.size() - kNeighbours;
    const std::size_t first = std::min(i < kNeighbours / 2 ? 0 : i - kNeighbours / 2, last);
    std::array<double, kNeighbours> near{};
    std::copy_n(level.begin() + static_cast<std::ptrdiff_t>(first), kNeighbours, near.begin());
    std::nth_element(near.begin(), near.begin() + kNeighbours / 2, near.end());
    out[i] = level[i] - near[kNeighbours / 2];
    if (i != first + kNeighbours / 2) out[i] *= kEndReadingFactor;
  }
  return out;
}

// Least-squares parabola, from normal equations for the readings minus the first reading.
// `variance` is the variance of the value divided by the variance of a single reading: the first
// diagonal element of the inverse of the normal equations.
struct Parabola {
  double value = 0, slope = 0, bend = 0, variance = 0;
  double at(double x) const { return value + x * (slope + x * bend); }
};

Parabola parabola(std::span<const double> x, std::span<const double> y) {
  std::array<double, 5> s{};
  std::array<double, 3> t{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    double power = 1;
    for (std::size_t k = 0; k < s.size(); ++k, power *= x[i]) {
      s[k] += power;
      if (k < t.size()) t[k] += power * (y[i] - y[0]);
    }
  }
  const double c00 = s[2] * s[4] - s[3] * s[3], c01 = s[2] * s[3] - s[1] * s[4];
  const double c02 = s[1] * s[3] - s[2] * s[2], c11 = s[0] * s[4] - s[2] * s[2];
  const double c12 = s[1] * s[2] - s[0] * s[3], c22 = s[0] * s[2] - s[1] * s[1];
  const double determinant = s[0] * c00 + s[1] * c01 + s[2] * c02;
  return {y[0] + (c00 * t[0] + c01 * t[1] + c02 * t[2]) / determinant,
          (c01 * t[0] + c11 * t[1] + c12 * t[2]) / determinant,
          (c02 * t[0] + c12 * t[1] + c22 * t[2]) / determinant, c00 / determinant};
}

// Returns a line through the median of the readings with the slope robust_slope(), because up to
// half of the readings may be spikes.
Parabola robust_line(std::span<const double> place, std::span<const double> reading) {
  Parabola line;
  line.slope = robust_slope(place, reading);
  std::vector<double> level(reading.begin(), reading.end());
  for (std::size_t i = 0; i < level.size(); ++i) level[i] -= line.slope * place[i];
  line.value = median_of(std::move(level));
  return line;
}

double rejection_limit(std::vector<double> deviations, double coarse) {
  for (double& size : deviations) size = std::abs(size);
  return std::max(coarse, kReject * kMadToSd * median_of(std::move(deviations)));
}

// Leaves out readings whose distance from this curve is above the limit. `alone`: no spikes were
// found by means of the neighbours. Then the limit is twelve times larger, and no reading is left
// out if the first or the last reading is beyond the limit, as after a step.
void keep_near(const Parabola& curve, double coarse, bool alone, std::vector<double>& x,
               std::vector<double>& y) {
  std::vector<double> left(y);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= curve.at(x[i]);
  const double limit = (alone ? kStrictFactor : 1) * rejection_limit(left, coarse);
  const auto is_far = [&](double of) { return std::abs(of) > limit; };
  if (alone && (is_far(left.front()) || is_far(left.back()))) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (is_far(left[i])) continue;
    x[kept] = x[i];
    y[kept++] = y[i];
  }
  x.resize(kept);
  y.resize(kept);
}

// Returns a correction of the slope at the target. It is calculated from a cubic term in the
// residuals of the parabola, for readings that are evenly spread over the bin. Without this
// correction the slope is too small if the readings are a wave.
double cubic_slope(std::span<const double> x, std::span<const double> left) {
  constexpr double kOdd = 0.6;
  double product = 0, square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double odd = x[i] * (x[i] * x[i] - kOdd);
    product += left[i] * odd;
    square += odd * odd;
  }
  return -kOdd * product / square;
}

}  // namespace

BinFit fit_bin(std::span<const double> place, std::span<const double> reading, double coarse,
               std::vector<double>& scratch) {
  BinFit fit;
  fit.used = reading.size();
  if (fit.used < kLeastReadingsPerBin) return fit;
  const std::vector<double> deviations = deviations_of(place, reading);
  const double limit = rejection_limit(deviations, coarse);
  std::vector<double> x;
  scratch.clear();
  for (std::size_t i = 0; i < reading.size(); ++i) {
    if (std::abs(deviations[i]) > limit) continue;
    x.push_back(place[i]);
    scratch.push_back(reading[i]);
  }
  // If at least three of five neighbours are spikes, their median is a spike, so none of these
  // spikes was left out.
  const bool alone = x.size() == reading.size();
  if (x.size() >= kLeastReadingsPerBin)
    keep_near(robust_line(place, reading), coarse, alone, x, scratch);
  if (x.size() < reading.size() && x.size() >= kLeastReadingsPerBin)
    keep_near(parabola(x, scratch), coarse, false, x, scratch);
  fit.used = x.size();
  fit.rejected = reading.size() - x.size();
  if (fit.used < kLeastReadingsPerBin) return fit;
  const Parabola curve = parabola(x, scratch);
  fit.value = curve.value;
  fit.slope = curve.slope;
  double square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    scratch[i] -= curve.at(x[i]);
    square += scratch[i] * scratch[i];
  }
  fit.slope += cubic_slope(x, scratch);
  const auto n = static_cast<double>(fit.used);
  fit.sd = std::sqrt(square / (n - static_cast<double>(kUnknowns)));
  fit.u = mean_uncertainty(scratch, fit.sd) * std::sqrt(std::max(1.0, n * curve.variance));
  return fit;
}

}  // namespace mdof::algo
