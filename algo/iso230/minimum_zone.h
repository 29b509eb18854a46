// The reference line about which a series deviates least.
#pragma once

#include <span>

#include "algo/iso230/line_fit.h"

namespace mdof::algo {

// The middle of the narrowest pair of parallel lines between which all readings lie, its width
// along y (ISO 1101, ISO 230-1; for slopes of mrad the width across the lines is the same to 1e-6).
// Exact: the width is the greatest distance along y between the upper and the lower convex hull
// (duality of linear programs), the slope that of the hull's edge there. Where several slopes give
// that width, the middle one. x ascending, at least two different; y of the same length (asserted).
// O(n). The uncertainties of the line are 0: not known.
Line minimum_zone_line(std::span<const double> x, std::span<const double> y);

}  // namespace mdof::algo
