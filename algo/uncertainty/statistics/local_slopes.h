// Slopes of the errors of a run along its axis.
#pragma once

#include <vector>

#include "schema/run.h"

namespace mdof::algo {

// Slope of the five errors at a target, per 1 m of the target's travel. Local frame, at the
// reference point of the run.
struct LocalSlope {
  Errors5 slope{};
  // Standard deviation of the true slope from `slope`: the form between the targets is unknown.
  Errors5 unseen{};
};

// One element for each point of a run. `slope` is that of the natural cubic spline through the mean
// errors of the targets, with the approach of the point. It is 0.87 of the true slope (root mean
// square) if the errors are a wave of three target intervals, 0.96 for four, and 0.99 for six.
//
// `unseen` is estimated from the changes of the chord from interval to interval, for the inner
// targets together: 0 if these changes show a smooth form. At the end targets `unseen` is 0,
// because the slope of the spline is usually too large there. The targets cannot show waves that
// are shorter than two intervals.
//
// If the targets of this approach are all at one place, the means of both approaches are used. If
// all targets are at one place, the slope is 0. Targets at a smaller distance than 2 % of the mean
// step are taken as one place, because the difference between them is mainly noise.
std::vector<LocalSlope> local_slopes(const Run& run);

}  // namespace mdof::algo
