// What a straight line between two targets of a table does not know: how far the axis bends away
// from it.
#pragma once

#include <vector>

#include "schema/compensation_table.h"

namespace mdof::algo {

// Of each interval of the positions the curvature, 1/m or rad/m², by which u between its targets is
// made: ½ (x - x_i) (x_{i+1} - x) curvature, 0 at the targets. It is R times the larger of the root
// mean squares of the second differences at the four nearest targets and at all. R, from 1 to 4,
// tells how rough the series is: second differences over one step against those over two; 1 for a
// parabola, 4 for what knows nothing of its neighbours, and where there are fewer than seven
// values. What noise (`u`, independent from target to target) does to the squares is subtracted.
// NaN among the values: left out. Fewer than three: nothing is known, and all is NaN.
std::vector<double> curvatures(const std::vector<double>& position_m,
                               const std::vector<double>& values, const std::vector<double>& u);

// Sets the curvatures of a table, which table_at() makes each time where they are not set.
void add_curvatures(CompensationTable& table);

}  // namespace mdof::algo
