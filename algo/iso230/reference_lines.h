// Straightness about each of the reference lines of ISO 230-1: end points, least squares, minimum
// zone.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/iso230/reference_lines.h"

namespace mdof::algo {

// Deviations (m) at positions (m), in any order. Readings at one position all count; the end-point
// line goes through the means of those at the first and at the last position. Errors: a number that
// is not finite or over 1000 km; fewer than three different positions, for a line goes through any
// two; positions so close together that a slope is not finite.
Result<ReferenceLines> reference_lines(std::span<const double> positions_m,
                                       std::span<const double> deviations_m);

}  // namespace mdof::algo
