// The mean error at each target, by approach: what straightness, squareness and tables are made of.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

enum class Approach { forward, reverse, both };
const char* to_string(Approach approach);  // "forward", "reverse", "mean"

struct TargetMean {
  int target = 0;         // as MeasuredPoint::target
  double position_m = 0;  // mean of the encoder
  Errors5 named{};  // of the moving body: mean over the runs, in the order of error_names(); m, rad
  Errors5 u{};      // standard uncertainty of that mean, see below
  // Signed: the part of u that all targets with one approach share, as the reversal of the others
  // grows along the axis. 0 of a target with both.
  Errors5 u_trend{};
  std::size_t n = 0;
};

// Means of the valid points of `points` at each target that has any, ascending in position.
// Of without_drift_of_runs(); the drift stays in u.
// Approach::both is the mean of the two directions' means; a target with one of them only is taken
// to have the mean reversal (forward - reverse) of the others, for its own approach would put it
// half a reversal off; its u has their scatter and, as large as it is at this target, their trend.
// Where no target has both, the one approach there is. u: the larger of the scatter between runs,
// s/√n (n > 1), and the mean's propagated noise: where runs repeat, what is slow between them is in
// it, and runs that are close by chance keep the noise. Of both directions' mean it is at least the
// scatter of the runs' means, both ways taken together.
std::vector<TargetMean> target_means(const MovingAxis& moving,
                                     const std::vector<MeasuredPoint>& points, Approach approach);

// What the line fits take of them.
std::vector<double> positions(const std::vector<TargetMean>& means);
std::vector<double> column(const std::vector<TargetMean>& means, std::size_t named);
// The same positions as travel of the moving body along + of M.
std::vector<double> own_travels(const Sides& sides, const std::vector<TargetMean>& means);

}  // namespace mdof::algo
