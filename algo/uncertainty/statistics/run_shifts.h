// How well least squares knows the shifts of runs against each other where runs lack visits
// (uneven_visits.h), and what that does to the means at the targets.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

using TargetAndWay = std::pair<int, int>;  // way: 1 forward, 0 reverse

// Changes of the mean of each target and approach by independent parts whose squares add, for noise
// of variance 1 that is independent from visit to visit: beside what the noise of its own visits
// does to a mean. `counted`: points that count in means. Nothing where no run lacks visits, as the
// shifts then are the same in all means, and of more than kMostShiftedRuns runs, where one shift
// has hardly a share in a mean.
inline constexpr std::size_t kMostShiftedRuns = 256;
std::vector<std::map<TargetAndWay, double>> parts_by_run_shifts(
    const std::vector<MeasuredPoint>& counted);

// What the shifts of the passes leave in these means, as means are made without that of the whole
// run only; local. Nothing where no run lacks visits.
std::map<TargetAndWay, Errors5> left_by_passes(const std::vector<MeasuredPoint>& counted);

}  // namespace mdof::algo
