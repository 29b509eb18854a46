// Noise and repeatability of the values of a table: each is a mean of one approach at a target less
// a reference made of the means of both approaches.
#pragma once

#include <array>
#include <vector>

#include "algo/iso230/target_means.h"

namespace mdof::algo {

// What a value refers to: a share of the mean of both approaches at each target.
using Reference = std::vector<double>;
Reference as_measured(std::size_t targets);  // nothing
// The value at a place between two targets, on the straight line; beyond them that of the end.
Reference interpolation_at(const std::vector<double>& x, double at);
Reference line_at(const std::vector<double>& x, double at);  // the least-squares line

// [named error][target] of one approach; NaN where it was not visited. `references`: of each named
// error and target. What is independent from visit to visit (repeatability.h) counts in the value
// and in its reference; a shift that all targets of a pass share cancels where there is a
// reference, but for half of what the passes of the two approaches differ by at random from run to
// run; where runs lack visits, this half moves each mean by its own share (run_shifts.h). `grid`:
// target_means() of both approaches of these points.
using SeriesOfErrors = std::array<std::vector<double>, kErrorCount>;
SeriesOfErrors table_uncertainty(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                                 const std::vector<TargetMean>& grid, Approach approach,
                                 const std::array<std::vector<Reference>, kErrorCount>& references);

}  // namespace mdof::algo
