// The parameters of ISO 230-2:2014 (clause 2, names and formulas) of readings at targets, and what
// its test plan asks for.
//
// With i target, j run, ↑ ↓ approach, x_ij deviation, s with n - 1:
//   x̄_i = (x̄_i↑ + x̄_i↓)/2    B_i = x̄_i↑ - x̄_i↓    B = max|B_i|    B̄ = mean of the signed B_i
//   R_i↑ = 4 s_i↑    R_i = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓)    R = max R_i
//   E↑ = range of x̄_i↑    E = range of x̄_i↑ and x̄_i↓ together    M = range of x̄_i
//   A↑ = max(x̄_i↑ + 2 s_i↑) - min(x̄_i↑ - 2 s_i↑)    A: the same over both approaches
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/iso230/positioning.h"
#include "schema/notice/notice.h"

namespace mdof::algo {

// Readings in any order; all at one target_m are of one target, and those of one run there all
// count. One reading of each target from each side is a single run: B, E and M are of it, R and A
// are NaN. Errors: a number that is not finite or over 1e6; a direction that is not +1 or -1; fewer
// than two targets; one reading of a target from a side where others have more; a target that lacks
// a side which others have.
Result<Positioning> positioning(const std::vector<PositioningReading>& readings);

// What of ISO 230-2:2014, 5.3 the targets and runs do not fulfil: at least five targets
// a metre and five in all, up to 2 m; five runs each way; as many everywhere; intervals that are
// not equal, and not whole periods of the scale (scale_period_m, 0: not known).
Notices plan_notices(const Positioning& positioning, double scale_period_m);

}  // namespace mdof::algo
