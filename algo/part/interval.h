// A coverage interval (95 %) from trials, and the value that is stated with it.
#pragma once

#include <algorithm>
#include <vector>

namespace mdof::algo {

// It contains the stated value.
struct Interval {
  double low = 0, high = 0;
  // The interval is not symmetric about the value. value ± U contains the whole interval.
  double U(double value) const { return std::max(high - value, value - low); }
};

// Sorts the trials. Returns the interval that contains 95 % of the trials, with as many trials
// below as above (JCGM 101).
Interval interval_of(std::vector<double>& trials);

// Sorts the trials.
double median_of(std::vector<double>& trials);

// A stated value belongs to its interval. So an interval without it gets longer.
Interval containing(double value, const Interval& interval);

}  // namespace mdof::algo
