#include "algo/points/robust_mean.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/model/lane_sum.h"
#include "algo/uncertainty/mean_uncertainty.h"

namespace mdof::algo {
namespace {

// For a hundred normally distributed readings the median absolute deviation can be up to a third
// too small. With a limit of six, a good reading was left out in about one of some hundred dwells.
constexpr double kReject = 8.0;
constexpr double kMadToSd = 1.4826;
constexpr double kFlickerSteps = 3.5;
// For a long dwell, median and median deviation are calculated from at most this many readings,
// which are evenly distributed over the dwell.
constexpr std::size_t kSubsample = 512;

// Moves the values for which `first` is true before the other values. Returns the end of these
// values. There are no branches, because a processor cannot predict comparisons of noise.
template <class First>
double* partition(double* begin, double* end, First first) {
  double* store = begin;
  for (double* p = begin; p != end; ++p) {
    const double x = *p;
    *p = *store;
    *store = x;
    store += first(x);
  }
  return store;
}

// Returns element n/2 of the sorted values by quickselect, which is several times faster on noise
// than std::nth_element. With at most kSubsample values its worst case takes little time. It also
// ends if a value is NaN, because each iteration removes at least the pivot.
double median(std::vector<double>& values) {
  double *begin = values.data(), *end = begin + values.size();
  double* const middle = begin + values.size() / 2;
  for (;;) {
    const double a = *begin, b = *middle, c = end[-1];
    const double pivot = std::max(std::min(a, b), std::min(std::max(a, b), c));
    double* const less = partition(begin, end, [=](double x) { return x < pivot; });
    if (middle < less) {
      end = less;
      continue;
    }
    begin = partition(less, end, [=](double x) { return !(pivot < x); });
    if (middle < begin) return pivot;
  }
}

// The deviations of rounded readings are multiples of a step, so their median is up to half a step
// too small. Returns the mean of the median (`middle`) and of the next larger deviation. For
// readings without rounding the difference is negligible.
double between_steps(const std::vector<double>& deviations, double middle) {
  if (middle == 0) return 0;
  double next = std::numeric_limits<double>::infinity();
  for (const double x : deviations)
    if (x > 1.001 * middle) next = std::min(next, x);
  return std::isfinite(next) ? 0.5 * (middle + next) : middle;
}

// If most readings are the same number, returns the largest allowed distance of the other readings.
// If several readings have the same smallest distance, this distance is the rounding step of the
// reading. The result is then at least kFlickerSteps steps, also if `coarse` is smaller.
double flicker_limit(std::span<const double> readings, double centre, double coarse) {
  double least = std::numeric_limits<double>::infinity();
  for (const double x : readings)
    if (x != centre) least = std::min(least, std::abs(x - centre));
  const auto alike = std::count_if(readings.begin(), readings.end(), [&](double x) {
    return x != centre && std::abs(x - centre) <= 1.05 * least;
  });
  return alike > 1 ? std::max(coarse, kFlickerSteps * least) : coarse;
}

}  // namespace

RobustMean robust_mean(std::span<const double> readings, double coarse,
                       std::vector<double>& scratch) {
  RobustMean result;
  if (readings.empty()) return result;
  const std::size_t stride = (readings.size() + kSubsample - 1) / kSubsample;
  scratch.clear();
  for (std::size_t i = 0; i < readings.size(); i += stride) scratch.push_back(readings[i]);
  const double centre = median(scratch);
  for (double& x : scratch) x = std::abs(x - centre);
  const double robust_sd = kMadToSd * between_steps(scratch, median(scratch));
  const double limit =
      robust_sd > 0 ? kReject * robust_sd : flicker_limit(readings, centre, coarse);

  // Sums of deviations lose no digits, because deviations are small numbers.
  scratch.resize(readings.size());
  for (const double x : readings) {
    scratch[result.used] = x - centre;
    result.used += std::abs(x - centre) <= limit;
  }
  result.rejected = readings.size() - result.used;
  const std::span<double> deviations(scratch.data(), result.used);
  const auto n = static_cast<double>(result.used);
  const double offset = lane_sum(deviations, [](const double* x) { return *x; }) / n;
  result.mean = centre + offset;
  if (result.used < 2) return result;
  for (double& x : deviations) x -= offset;
  const double square = lane_sum(deviations, [](const double* e) { return *e * *e; });
  result.sd = std::sqrt(square / (n - 1));
  result.u = mean_uncertainty(deviations, result.sd);
  return result;
}

}  // namespace mdof::algo
