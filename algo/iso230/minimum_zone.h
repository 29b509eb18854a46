// The reference line with the smallest deviations of a series.
#pragma once

#include <span>

#include "algo/iso230/line_fit.h"

namespace mdof::algo {

// The centre line of the narrowest pair of parallel lines that enclose all readings; the width is
// along y (ISO 1101, ISO 230-1; for slopes of mrad the width perpendicular to the lines is the same
// within 1e-6). The result is exact: the width is the largest distance along y between the upper
// and the lower convex hull (duality of linear programs), and the slope is that of the hull's edge
// there. If several slopes give this width, the result has the middle one. x is ascending with at
// least two different values; y has the same length (asserted). O(n). The uncertainties of the line
// are 0 and mean unknown.
Line minimum_zone_line(std::span<const double> x, std::span<const double> y);

}  // namespace mdof::algo
