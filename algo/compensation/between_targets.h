// Uncertainty of linear interpolation between two targets of a table: how far the errors can
// deviate from the straight line.
#pragma once

#include <vector>

#include "schema/compensation_table.h"

namespace mdof::algo {

// Returns the curvature of the errors in each interval between two positions, 1/m or rad/m². The
// standard uncertainty of interpolation at x between the targets x_i and x_{i+1} is
// ½ (x - x_i) (x_{i+1} - x) curvature.
//
// The curvature is R times the root mean square of the second differences of the values. A second
// difference shows the error of interpolation at its middle target if this target is left out. The
// mean is over the squares of the four nearest second differences (weight 1 each) and the mean
// square of all second differences (weight 6). The contribution of noise to the squares is
// subtracted; `u` is this noise, which is independent from target to target.
//
// The second differences of targets that are close to each other may contain only noise. Therefore
// the curvature in an interval is also calculated from only those second differences whose length
// is at least half of the interval. The larger of the two curvatures is used.
//
// R is the ratio of the curvature at half a step to the curvature at one step. q is the ratio of
// the curvature from neighbouring targets to the curvature from every second target (root mean
// squares), limited to 1 ... 4.
// - q up to 2.2: R = 2√q/(1 + √q), which holds for a wave of any length and is 1 for a parabola
// - q above 2.2: R = q²/4, because waves may be shorter than the targets can show
// - three or four second differences (five or six values): R = 2
// - fewer second differences: R = 4
//
// Values that are NaN are left out. With fewer than three values all curvatures are NaN.
std::vector<double> curvatures(const std::vector<double>& position_m,
                               const std::vector<double>& values, const std::vector<double>& u);

// Beyond the first or the last target, the value of this target is held. Returns the standard
// uncertainty of the change of the error over the distance to this target, from the change of the
// error over the end interval and the curvature in it. A NaN curvature counts as 0.
double u_beyond_end(double distance, double interval, double change, double curvature);

// Sets the curvatures of a table. If a table has no curvatures, table_at() calculates them at each
// call.
void add_curvatures(CompensationTable& table);

}  // namespace mdof::algo
