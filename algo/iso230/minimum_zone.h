// The minimum zone reference line of a series.
#pragma once

#include <span>

#include "algo/iso230/line_fit.h"

namespace mdof::algo {

// Returns the centre line of the narrowest pair of parallel lines that enclose all readings (ISO
// 1101, ISO 230-1). The width between the lines is measured along y; for slopes of mrad the width
// perpendicular to the lines differs by less than 1e-6. The result is exact: the width is the
// largest distance along y between the upper and the lower convex hull (duality of linear
// programs), and the slope is the slope of the edge of the hull at this position. If several slopes
// have this width, the result is the middle slope. The uncertainties of the line are 0, because
// they are unknown. x is ascending with at least two different values; y has the same length
// (asserted). The calculation time is O(n).
Line minimum_zone_line(std::span<const double> x, std::span<const double> y);

}  // namespace mdof::algo
