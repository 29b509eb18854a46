// Uncertainty of the shifts of runs against each other, by least squares, if runs lack visits
// (uneven_visits.h), and its effect on the means at the targets.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "algo/iso230/target_means.h"
#include "schema/point.h"

namespace mdof::algo {

using TargetAndApproach = std::pair<int, int>;  // way: 1 forward, 0 reverse

// Changes of the mean of each target and approach by independent parts whose squares add, for noise
// of variance 1 that is independent from visit to visit. They come in addition to the noise of the
// visits of the mean itself. `counted`: points that count in means. Empty if no run lacks visits,
// because the shifts are then the same in all means, and for more than kMostShiftedRuns runs,
// because one shift then hardly changes a mean.
inline constexpr std::size_t kMostShiftedRuns = 256;
std::vector<std::map<TargetAndApproach, double>> parts_by_run_shifts(
    const std::vector<MeasuredPoint>& counted);

// Effect of the levels of the passes on the means, from which only the level of each whole run is
// removed. A level that both passes of a run share is the level of the run. Half the difference of
// the two passes varies from run to run, and stays in the means if a run lacks a part of a pass.
struct PassLevels {
  // By a half difference of 1 in one run each. Empty if no run lacks visits, for more than
  // kMostShiftedRuns runs, and if fewer than two runs have both passes.
  std::vector<std::map<TargetAndApproach, double>> parts;
  Errors5 u_half{};  // standard deviation of the half difference, less its noise; named
  double freedom = std::numeric_limits<double>::infinity();
};
// `u_visit`: u of one visit, independent of the other visits; named errors.
PassLevels pass_levels(const MovingAxis& moving, const std::vector<MeasuredPoint>& counted,
                       const Errors5& u_visit);

}  // namespace mdof::algo
