// Uncertainty of the shifts of the runs relative to each other, and its effect on the means at the
// targets. This effect exists only if runs lack visits (uneven_visits.h). The shifts are fitted by
// least squares.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "algo/iso230/target_means.h"
#include "schema/point.h"

namespace mdof::algo {

using TargetAndApproach = std::pair<int, int>;  // target; 1 forward, 0 reverse

// Change of the mean of each target and approach by each independent part of the shifts, if the
// noise of the visits is independent and has the variance 1. The squares of the parts add. The
// noise of the visits of a mean is not included. `counted`: points that are used in means. Empty in
// two cases: no run lacks visits, because the shifts are then the same in all means; or more than
// kMostShiftedRuns runs, because one shift then hardly changes a mean.
inline constexpr std::size_t kMostShiftedRuns = 256;
std::vector<std::map<TargetAndApproach, double>> parts_by_run_shifts(
    const std::vector<MeasuredPoint>& counted);

// Effect of the different levels of the two passes of a run on the means. The mean level of both
// passes is the level of the run, and is removed from the means. Half the difference of the levels
// of the two passes varies from run to run. This half difference is not removed, and changes the
// means if a run lacks a part of a pass.
struct PassLevels {
  // parts[i]: changes of the means if the half difference of run i is 1. Empty if no run lacks
  // visits, if there are more than kMostShiftedRuns runs, or if fewer than two runs have both
  // passes.
  std::vector<std::map<TargetAndApproach, double>> parts;
  // Standard deviation of the half difference without the noise of the visits; named errors.
  Errors5 u_half{};
  double freedom = std::numeric_limits<double>::infinity();
};
// `u_visit`: u of one visit, independent from visit to visit; named errors.
PassLevels pass_levels(const MovingAxis& moving, const std::vector<MeasuredPoint>& counted,
                       const Errors5& u_visit);

}  // namespace mdof::algo
