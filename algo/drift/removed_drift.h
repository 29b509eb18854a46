// Uncertainty of the errors of a run due to the removal of the drift.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns the contributor of a run from which a drift was removed. It has no key in the rig,
// because mdof calculates it from the run: from the readings, which still contain the drift. All
// points share the error of the estimated drift, so the mean of many visits does not reduce this
// error. If an older version of mdof subtracted another drift, the difference is a part of the
// uncertainty. Empty: no drift was removed. Errors: those of Solver::create().
Result<std::vector<Contributor>> removed_drift(const Rig& rig, const Run& run);

}  // namespace mdof::algo
