// Noise and repeatability of the values of a table. Each value is the mean of one approach at a
// target minus a reference, which is made of the means of both approaches.
#pragma once

#include <array>
#include <vector>

#include "algo/iso230/target_means.h"

namespace mdof::algo {

// The reference of a value: the share of the mean of both approaches at each target.
using Reference = std::vector<double>;
Reference as_measured(std::size_t targets);  // no reference
// Linear interpolation between two targets; outside, the end value is held.
Reference interpolation_at(const std::vector<double>& x, double at);
Reference line_at(const std::vector<double>& x, double at);  // the least-squares line

// u of [named error][target] of one approach; NaN if it was not visited. `references`: of each
// named error and target. The part that is independent from visit to visit (repeatability.h) counts
// in the value and in its reference. A shift common to all targets of a pass cancels if there is a
// reference, except half of the random difference from run to run between the passes of the two
// approaches. If runs lack visits, this half changes each mean by its own share (run_shifts.h).
// `grid`: target_means() of both approaches of these points.
using SeriesOfErrors = std::array<std::vector<double>, kErrorCount>;
SeriesOfErrors table_uncertainty(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                                 const std::vector<TargetMean>& grid, Approach approach,
                                 const std::array<std::vector<Reference>, kErrorCount>& references);

}  // namespace mdof::algo
