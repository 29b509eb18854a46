// Straightness relative to each reference line of ISO 230-1: end points, least squares, minimum
// zone.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/iso230/reference_lines.h"

namespace mdof::algo {

// The positions may be in any order, with several deviations at one position. The end-point line is
// the line through the means at the first and at the last position. Errors: a number that is not
// finite or above 1000 km; fewer than three different positions, because any two points are on a
// line; positions so close together that a slope is not finite.
Result<ReferenceLines> reference_lines(std::span<const double> positions_m,
                                       std::span<const double> deviations_m);

}  // namespace mdof::algo
