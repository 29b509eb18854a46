// Squareness calculated with each reference line of straightness (ISO 230-1).
#pragma once

#include "schema/base/result.h"
#include "schema/iso230/reference_lines.h"
#include "schema/iso230/squareness.h"
#include "schema/run.h"

namespace mdof::algo {

// Fits the reference lines to the straightness of the two runs of `fitted` (means of both
// approaches; the reference point is the fixture). least_squares has the values of `fitted`. Error:
// a run with fewer than three targets.
Result<SquarenessByLine> squareness_lines(const Run& run_a, const Run& run_b,
                                          const Squareness& fitted);

}  // namespace mdof::algo
