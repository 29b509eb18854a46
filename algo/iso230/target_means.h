// Calculates the mean error at each target for each approach. The means are the input of
// straightness, squareness and tables.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

enum class Approach { forward, reverse, both };
const char* to_string(Approach approach);  // "forward", "reverse", "mean"

struct TargetMean {
  int target = 0;         // same as MeasuredPoint::target
  double position_m = 0;  // mean encoder position
  // Mean errors over the runs for the moving body, in the order of error_names(); m, rad.
  Errors5 named{};
  Errors5 u{};  // standard uncertainty of the mean, see target_means()
  // Part of u due to the change of the reversal along the axis, with sign. The parts of all targets
  // with only one approach are fully correlated. 0 at a target with both approaches.
  Errors5 u_trend{};
  std::size_t n = 0;  // number of points
};

// Returns the means of the valid points at each target with valid points, in ascending order of
// position. subtract_run_drifts() removes the drift between runs; u contains the uncertainty of
// this drift.
//
// Approach::both is the mean of the forward mean and the reverse mean. If a target has one approach
// only, this mean would differ by half of the reversal (forward - reverse). The reversal of this
// target is therefore assumed to be the mean reversal of the other targets. u of the assumed
// reversal contains the scatter of the known reversals, and their trend extrapolated to this
// target. If no target has both approaches, the existing approach is used.
//
// u is the larger of two values: the scatter between n runs, s/√n (n > 1), and the propagated noise
// of the mean. The scatter contains slow changes between runs. The noise is the lower limit if the
// runs agree by chance. For Approach::both, the mean of both approaches is also calculated for each
// run; u is at least s/√n of these means.
std::vector<TargetMean> target_means(const MovingAxis& moving,
                                     const std::vector<MeasuredPoint>& points, Approach approach);

// Input of the line fits.
std::vector<double> positions(const std::vector<TargetMean>& means);
std::vector<double> column(const std::vector<TargetMean>& means, std::size_t named);
// Returns the positions converted to travel of the moving body in the + direction of M.
std::vector<double> own_travels(const Sides& sides, const std::vector<TargetMean>& means);

}  // namespace mdof::algo
