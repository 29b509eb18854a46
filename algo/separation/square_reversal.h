// Squareness by reversal: the same two axes against the same square in two set-ups, the square
// turned over in between, so that its angle error goes in with the other sign. With m the
// squareness by the slopes alone and c the corner (schema/iso230/squareness.h)
//   EC0Y = m1 + c1 α = m2 + c2 α, c2 = -c1:   EC0Y = (m1 + m2)/2,   α = c1 (m2 - m1)/2
#pragma once

#include "schema/base/result.h"
#include "schema/separation/square_reversal.h"
#include "schema/uncertainty/budget.h"

namespace mdof::algo {

// One set-up: EC0Y as it comes out of a square taken to be true, and its budget.
struct SquareSetUp {
  int corner = 0;
  Budget budget;
};

// What is declared of the rigs is taken as common to both set-ups: it then stays whole in EC0Y, and
// in the angle of the square the two are added, which is their largest effect. Noise and
// repeatability are independent. Error: a corner that is not known, or that is the same twice.
Result<SquareReversal> square_reversal(const SquareSetUp& first, const SquareSetUp& second);

}  // namespace mdof::algo
