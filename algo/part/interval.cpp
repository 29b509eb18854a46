#include "algo/part/interval.h"

namespace mdof::algo {

Interval interval_of(std::vector<double>& trials) {
  std::sort(trials.begin(), trials.end());
  const std::size_t outside = trials.size() / 40;  // 2.5 % on each side
  return {trials[std::max<std::size_t>(1, outside) - 1],
          trials[std::min(trials.size() - outside, trials.size() - 1)]};
}

double median_of(std::vector<double>& trials) {
  std::sort(trials.begin(), trials.end());
  return trials[trials.size() / 2];
}

Interval containing(double value, const Interval& interval) {
  return {std::min(interval.low, value), std::max(interval.high, value)};
}

}  // namespace mdof::algo
