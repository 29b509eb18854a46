// Decides whether a figure conforms to its tolerance: ISO 14253-1:2017.
#pragma once

#include <string>

#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::algo {

// `limit`: largest permitted size of the figure. The standard's default is a conformance
// probability of 95 %, one-sided: conform if |value| + g <= limit, not conform if |value| - g >
// limit. The guard band g is 1.645 u, or by Student's t if u has few degrees of freedom. Earlier
// editions used U (k = 2). The rule is two-sided if the limit is less than 2.4 u, because then
// either end counts. For a range, whose trials are not normal, g is U, which is larger. Between
// these limits there is no decision, and also if U is known to be incomplete, because the rigs do
// not declare all uncertainties or no target was visited again.
// `against`: why the run itself permits no decision; empty: it permits one.
Decision decision(const Budget& budget, double limit, const std::string& against = "");

}  // namespace mdof::algo
