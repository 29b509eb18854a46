// Parallelism of two motions along one axis (ISO 230-1).
#pragma once

#include "schema/base/result.h"
#include "schema/iso230/parallelism.h"
#include "schema/run.h"

namespace mdof::algo {

// Lines through the mean of both approaches of each straightness error, at the fixture; budgets are
// left to parallelism_budget(). That neither target nor fixture was moved against the machine
// between the runs is the user's word: a run does not know it. Errors: runs of two axes; fewer than
// three targets; travels that have less than half of the longer one in common; as check_usable().
Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial = false);

}  // namespace mdof::algo
