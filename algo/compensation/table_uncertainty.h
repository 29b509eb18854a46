// Uncertainty of the values of a table due to noise and repeatability. Each value is the mean of
// one approach, or of both approaches, at a target minus a reference. The reference is a weighted
// sum of the means of both approaches.
#pragma once

#include <array>
#include <vector>

#include "algo/iso230/target_means.h"

namespace mdof::algo {

// The reference of a value: for each target the weight of the mean of both approaches.
using Reference = std::vector<double>;
Reference as_measured(std::size_t targets);  // all weights 0: no reference
// Reference of linear interpolation between two targets; outside the targets the end value is held.
Reference interpolation_at(const std::vector<double>& x, double at);
Reference line_at(const std::vector<double>& x, double at);  // reference of the least-squares line

// Returns u of one approach, or of the means of both approaches, as [named error][target]; NaN if
// the approach did not visit the target.
// `references`: [named error][target]. `grid`: target_means() of both approaches of these points.
// - The noise that is independent from visit to visit (repeatability.h) changes the value and its
//   reference.
// - A shift that all targets of a pass have in common cancels if there is a reference. One part
//   does not cancel in the value of one approach: half of the difference between the forward and
//   the reverse pass, which varies from run to run. If some visits of a run are missing, this half
//   changes each mean by a different share (run_shifts.h).
using SeriesOfErrors = std::array<std::vector<double>, kErrorCount>;
SeriesOfErrors table_uncertainty(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                                 const std::vector<TargetMean>& grid, Approach approach,
                                 const std::array<std::vector<Reference>, kErrorCount>& references);

}  // namespace mdof::algo
