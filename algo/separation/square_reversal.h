// Squareness by reversal: the same two axes are measured with the same square in two set-ups. The
// square is turned over between the set-ups, so that its angle error α has the opposite sign. For
// the set-ups 1 and 2, m is the squareness from the slopes only, and c is the corner
// (schema/iso230/squareness.h):
//   EC0Y = m1 + c1 α = m2 + c2 α,   c2 = -c1
//   EC0Y = (m1 + m2)/2,   α = c1 (m2 - m1)/2
#pragma once

#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/separation/square_reversal.h"
#include "schema/uncertainty/budget.h"

namespace mdof::algo {

// One set-up. `budget`: budget of EC0Y for a square without angle error.
struct SquareSetUp {
  int corner = 0;
  Budget budget;
};

// The declared uncertainties of the rigs are taken as common to both set-ups. Therefore u of EC0Y
// and u of the angle of the square contain the mean of the two declared uncertainties, without
// reduction. For the angle, this is their largest possible effect. Noise and repeatability of the
// set-ups are independent. Errors: a corner is unknown; both set-ups have the same corner.
Result<SquareReversal> square_reversal(const SquareSetUp& first, const SquareSetUp& second);

// Compares the angle of the square with the angles that the rigs declare. Notices: two rigs declare
// different angles; a declared angle differs from the found angle by more than three times the
// combined standard uncertainty. A u that the rig does not declare counts as 0.
Notices square_notices(const SquareReversal& found, const std::vector<const Rig*>& rigs);

}  // namespace mdof::algo
