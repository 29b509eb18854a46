// How well least squares knows the shifts of runs against each other where runs lack visits
// (uneven_visits.h), and what that does to the means at the targets.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "algo/iso230/target_means.h"
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

// What levels of the passes do to the means, which are made without that of the whole run only. A
// level of both passes of a run is that of the run; half of what they differ by, from run to run,
// stays in the means where a run lacks a part of a pass.
struct PassLevels {
  // By 1 of this half difference of one run each. Nothing where no run lacks visits, of more than
  // kMostShiftedRuns runs, and where fewer than two runs have both passes.
  std::vector<std::map<TargetAndWay, double>> parts;
  Errors5 u_half{};  // standard deviation of the half difference, without that of its noise; named
  double freedom = std::numeric_limits<double>::infinity();
};
// `u_visit`: of one visit, independent of the others; named.
PassLevels pass_levels(const MovingAxis& moving, const std::vector<MeasuredPoint>& counted,
                       const Errors5& u_visit);

}  // namespace mdof::algo
