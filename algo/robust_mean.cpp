#include "algo/robust_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kReject = 6.0;
constexpr double kMadToSd = 1.4826;
// Median and deviation of a long dwell are taken from at most this many readings, evenly spread.
constexpr std::size_t kSubsample = 512;
constexpr double kMaxCorrelation = 0.98;

// Puts the values for which `first` holds before the others; gives their end. Without branches, as
// no processor can guess how noise compares.
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

// Element n/2 of the n values in order. Quickselect: on noise several times faster than
// std::nth_element, and at most kSubsample values at a time, so that no order of them hurts.
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
    begin = partition(less, end, [=](double x) { return x == pivot; });
    if (middle < begin) return pivot;
  }
}

// Sum of term(&x) over x, as eight sums side by side: a single one would wait for each addition. In
// the same order on every machine.
template <class Term>
double sum(std::span<const double> x, Term term) {
  constexpr std::size_t kSums = 8;
  std::array<double, kSums> sums{};
  std::size_t i = 0;
  for (; i + kSums <= x.size(); i += kSums)
    for (std::size_t k = 0; k < kSums; ++k) sums[k] += term(&x[i + k]);
  for (std::size_t k = 0; i < x.size(); ++i, ++k) sums[k] += term(&x[i]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
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
  const double robust_sd = kMadToSd * median(scratch);
  const double limit = robust_sd > 0 ? kReject * robust_sd : coarse;

  // From here on small numbers: nothing is lost to the offset.
  scratch.resize(readings.size());
  for (const double x : readings) {
    scratch[result.used] = x - centre;
    result.used += std::abs(x - centre) <= limit;
  }
  result.rejected = readings.size() - result.used;
  const std::span<double> deviations(scratch.data(), result.used);
  const auto n = static_cast<double>(result.used);
  const double offset = sum(deviations, [](const double* x) { return *x; }) / n;
  result.mean = centre + offset;
  if (result.used < 2) return result;
  for (double& x : deviations) x -= offset;
  const double square = sum(deviations, [](const double* e) { return *e * *e; });
  const double lagged = sum(deviations.subspan(1), [](const double* e) { return e[0] * e[-1]; });
  result.sd = std::sqrt(square / (n - 1));
  const double rho = square > 0 ? std::clamp(lagged / square, 0.0, kMaxCorrelation) : 0.0;
  result.u = result.sd / std::sqrt(n) * std::sqrt((1 + rho) / (1 - rho));
  return result;
}

}  // namespace mdof::algo
