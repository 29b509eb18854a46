// Is a figure within its tolerance? ISO 14253-1:2017.
#pragma once

#include <string>

#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::algo {

// Of a figure that must be at most `limit` in size. The standard's default is a probability of 95 %
// that what is said is true, one-sided: conform is |value| + g <= limit, not conform |value| - g >
// limit, with the guard band g = 1.645 u, or by Student's t where u has few degrees of freedom. The
// editions before took U (k = 2). Two-sided where the limit is within 2.4 u of 0, so that either
// end counts. Of a range, whose trials are not normal, g is U: the larger. Undecided between, and
// wherever U is known to be incomplete, as rigs do not declare all or no target was visited again.
// `against`: why nothing can be decided of the run itself; empty: nothing is against it.
Decision decision(const Budget& budget, double limit, const std::string& against = "");

}  // namespace mdof::algo
