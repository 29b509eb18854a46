// Parallelism of two motions along one axis (ISO 230-1).
#pragma once

#include "schema/base/result.h"
#include "schema/iso230/parallelism.h"
#include "schema/run.h"

namespace mdof::algo {

// Fits lines to the mean of both approaches of each straightness error, at the fixture.
// parallelism_budget() sets the budgets. A run does not show whether target and fixture stayed in
// place on the machine between the runs; the user must ensure it. Errors: runs of two different
// axes; fewer than three targets; common travel below half of the longer travel; those of
// check_usable().
Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial = false);

}  // namespace mdof::algo
