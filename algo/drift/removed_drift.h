// Uncertainty of the errors of a run due to the removal of the drift.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns the contributors of a run from which a drift was removed. These contributors have no key
// in the rig, because mdof calculates them from the run. All points share the error of the
// estimated drift, so the mean of many visits does not reduce this error. Empty: no drift was
// removed.
std::vector<Contributor> removed_drift(const Run& run);

}  // namespace mdof::algo
