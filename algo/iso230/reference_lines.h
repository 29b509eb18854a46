// Straightness about each reference line of ISO 230-1: end points, least squares, minimum zone.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/iso230/reference_lines.h"

namespace mdof::algo {

// Deviations (m) at positions (m), in any order. All readings at one position count; the end-point
// line goes through the means at the first and at the last position. Errors: a number that is not
// finite or above 1000 km; fewer than three different positions, because a line fits any two;
// positions so close together that a slope is not finite.
Result<ReferenceLines> reference_lines(std::span<const double> positions_m,
                                       std::span<const double> deviations_m);

}  // namespace mdof::algo
