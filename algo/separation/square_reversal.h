// Squareness by reversal: the same two axes are measured with the same square in two set-ups. The
// square is turned over between them, so that its angle error has the opposite sign. With m the
// squareness by the slopes alone and c the corner (schema/iso230/squareness.h)
//   EC0Y = m1 + c1 α = m2 + c2 α, c2 = -c1:   EC0Y = (m1 + m2)/2,   α = c1 (m2 - m1)/2
#pragma once

#include "schema/base/result.h"
#include "schema/separation/square_reversal.h"
#include "schema/uncertainty/budget.h"

namespace mdof::algo {

// One set-up: EC0Y for a square without angle error, and its budget.
struct SquareSetUp {
  int corner = 0;
  Budget budget;
};

// The declared uncertainties of the rigs are taken as common to both set-ups. They remain complete
// in EC0Y; for the angle of the square the two are added, which is their largest effect. Noise and
// repeatability are independent. Error: a corner that is unknown, or the same corner twice.
Result<SquareReversal> square_reversal(const SquareSetUp& first, const SquareSetUp& second);

}  // namespace mdof::algo
