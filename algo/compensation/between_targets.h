// Uncertainty of linear interpolation between two targets of a table: how far the errors can
// deviate from the straight line.
#pragma once

#include <vector>

#include "schema/compensation_table.h"

namespace mdof::algo {

// For each interval of the positions the curvature, 1/m or rad/m². It gives u between the two
// targets: ½ (x - x_i) (x_{i+1} - x) curvature, which is 0 at the targets. The curvature is R times
// the root mean square of second differences, which is what the omission of each target shows. The
// mean square is over the four nearest targets and over all targets (with a weight of six). The
// contribution of noise (`u`, independent from target to target) to the squares is subtracted.
//
// R scales the curvature to half the step. With the ratio q (1 to 4) of the second differences over
// one step to those over two steps, a wave of any length has R = 2√q/(1 + √q), which is 1 for a
// parabola. If q is above 2.2, waves may be shorter than the targets can show, and R = q²/4. With
// five or six values R = 2, with fewer R = 4.
// Values that are NaN are left out. With fewer than three values all curvatures are NaN.
std::vector<double> curvatures(const std::vector<double>& position_m,
                               const std::vector<double>& values, const std::vector<double>& u);

// Sets the curvatures of a table. Without them table_at() calculates them at each call.
void add_curvatures(CompensationTable& table);

}  // namespace mdof::algo
