// Calculates the parameters of ISO 230-2:2014 (clause 2) from readings at targets, and checks the
// requirements of the standard for the test.
//
// i: target, j: run, ↑ ↓: forward and reverse approach, x_ij: deviation, s: standard deviation with
// n - 1:
//   x̄_i = (x̄_i↑ + x̄_i↓)/2    B_i = x̄_i↑ - x̄_i↓    B = max|B_i|    B̄ = mean of the signed B_i
//   R_i↑ = 4 s_i↑    R_i = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓)    R = max R_i
//   E↑ = range of x̄_i↑    E = range of x̄_i↑ and x̄_i↓ together    M = range of x̄_i
//   A↑ = max(x̄_i↑ + 2 s_i↑) - min(x̄_i↑ - 2 s_i↑)    A: range over both approaches
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/iso230/positioning.h"
#include "schema/notice/notice.h"

namespace mdof::algo {

// Readings may be in any order. All readings with the same target_m belong to one target; a run can
// have several readings at a target. If each target has one reading for each approach, there is
// only one run: B, E and M are calculated, and R and A are NaN. Errors:
// - a number that is not finite or above 1e6
// - a direction other than +1 or -1
// - fewer than two targets
// - a target that has one reading for an approach although other targets have more
// - a target without readings for an approach that other targets have
Result<Positioning> positioning(const std::vector<PositioningReading>& readings);

// Returns notices about the requirements of ISO 230-2:2014, 5.3 that the targets and runs do not
// fulfil:
// - at least five targets per metre and five in total, for a travel up to 2 m
// - five runs in each direction
// - the same number of runs at each target
// - intervals that differ from each other and are not multiples of the period of the scale
//   (scale_period_m; 0: unknown)
Notices plan_notices(const Positioning& positioning, double scale_period_m);

// Returns a notice if the deviations are probably absolute positions. Their slope over the targets
// is then 1, or 0.001 if positions in mm were given as µm.
Notices slope_notices(const Positioning& positioning);

}  // namespace mdof::algo
