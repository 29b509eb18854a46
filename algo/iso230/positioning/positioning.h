// The parameters of ISO 230-2:2014 (clause 2, names and formulas) from readings at targets, and the
// requirements of its test plan.
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

// Readings may be in any order. All readings with one target_m belong to one target, and several
// readings of one run there all count. If each target has one reading from each side, this is a
// single run: it has B, E and M, but R and A are NaN. Errors: a number that is not finite or above
// 1e6; a direction other than +1 or -1; fewer than two targets; one reading of a target from a side
// if others have more; a target without readings from a side that others have.
Result<Positioning> positioning(const std::vector<PositioningReading>& readings);

// The requirements of ISO 230-2:2014, 5.3 that targets and runs do not fulfil: at least five
// targets per metre and five in total, up to 2 m; five runs in each direction; the same number of
// runs at each target; unequal intervals that are not whole periods of the scale (scale_period_m,
// 0: unknown).
Notices plan_notices(const Positioning& positioning, double scale_period_m);

}  // namespace mdof::algo
