// Parallelism of two motions along one axis (ISO 230-1).
#pragma once

#include "schema/base/result.h"
#include "schema/iso230/parallelism.h"
#include "schema/run.h"

namespace mdof::algo {

// Fits a line to each straightness error (mean of both approaches; the reference point is the
// fixture). parallelism_budget() sets the budgets. Target and fixture must not be moved on the
// machine between the two runs. The runs do not show such a movement, so the user must prevent it.
// Errors: runs of two different axes; fewer than three targets; common travel below half of the
// longer travel; the errors of check_usable().
Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial = false);

}  // namespace mdof::algo
