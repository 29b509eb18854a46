// The mean error at each target by approach, the input of straightness, squareness and tables.
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
  double position_m = 0;  // mean of the encoder
  // Mean over the runs for the moving body, in the order of error_names(); m, rad.
  Errors5 named{};
  Errors5 u{};  // standard uncertainty of the mean, see target_means()
  // Signed part of u that all targets with one approach share, because the reversal of the other
  // targets changes along the axis. 0 at a target with both approaches.
  Errors5 u_trend{};
  std::size_t n = 0;
};

// Means of the valid points at each target that has any, ascending in position. The drift is
// removed with subtract_run_drifts(), and u contains it. Approach::both is the mean of the means
// of the two directions. A target with one direction only is assumed to have the mean reversal
// (forward - reverse) of the others, because its own approach alone would shift it by half a
// reversal; its u contains their scatter and their trend, extrapolated to this target. If no target
// has both approaches, the only approach is used.
//
// u is the larger of the scatter between runs, s/√n (n > 1), and the propagated noise of the mean.
// So u contains slow changes between repeated runs, and runs that agree by chance keep the noise.
// For the mean of both directions u is at least the scatter of the means of the runs over both
// directions.
std::vector<TargetMean> target_means(const MovingAxis& moving,
                                     const std::vector<MeasuredPoint>& points, Approach approach);

// Input of the line fits.
std::vector<double> positions(const std::vector<TargetMean>& means);
std::vector<double> column(const std::vector<TargetMean>& means, std::size_t named);
// The same positions as travel of the moving body in the + direction of M.
std::vector<double> own_travels(const Sides& sides, const std::vector<TargetMean>& means);

}  // namespace mdof::algo
