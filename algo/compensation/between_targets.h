// What a straight line between two targets of a table does not know: how far the axis bends away
// from it.
#pragma once

#include <vector>

#include "schema/compensation_table.h"

namespace mdof::algo {

// Of each interval of the positions the curvature, 1/m or rad/m², by which u between its targets is
// made: ½ (x - x_i) (x_{i+1} - x) curvature, 0 at the targets. It is R times the root mean square
// of the second differences, which is what leaving out each target shows: of all, with the weight
// of six, and of the four nearest targets. What noise (`u`, independent from target to target) does
// to the squares is subtracted. R scales it to half the step. With q, from 1 to 4, the second
// differences over one step by those over two, a wave of any length has R = 2√q/(1 + √q), 1 for a
// parabola. Of q above 2.2 waves may be shorter than the targets show: R = q²/4. With five or six
// values R = 2, with fewer 4.
// NaN among the values: left out. Fewer than three: nothing is known, and all is NaN.
std::vector<double> curvatures(const std::vector<double>& position_m,
                               const std::vector<double>& values, const std::vector<double>& u);

// Sets the curvatures of a table, which table_at() makes each time where they are not set.
void add_curvatures(CompensationTable& table);

}  // namespace mdof::algo
