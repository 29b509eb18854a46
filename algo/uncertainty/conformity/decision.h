// Decides by ISO 14253-1:2017 whether a figure conforms to its tolerance.
#pragma once

#include <string>

#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::algo {

// `limit`: largest permitted magnitude of the figure. With the guard band g:
//   conform:      |value| + g <= limit
//   not conform:  |value| - g > limit
//   no decision:  all other values
// The default of the standard is a conformance probability of 95 %, one-sided. Then g = 1.645 u, or
// the factor of Student's t distribution for few degrees of freedom. Earlier editions of the
// standard used g = U (k = 2). If the limit is less than 2.4 u, the true value can be beyond either
// end of the tolerance, and the rule is two-sided. For a range g = U, because the ranges of the
// trials have no normal distribution; this g is larger. There is also no decision if U is known to
// be incomplete: the rigs do not declare all uncertainties, or no target has repeated visits.
// `against`: reason why the run does not permit a decision; empty if there is no such reason.
Decision decision(const Budget& budget, double limit, const std::string& against = "");

}  // namespace mdof::algo
