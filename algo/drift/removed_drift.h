// Uncertainty of a run due to the removal of its drift.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/run.h"

namespace mdof::algo {

// Contributors of a run from which a drift was removed. They have no key in the rig, because the
// run itself shows them. All points share the error of the drift, so the means of many visits
// contain all of it. Empty: no drift was removed.
std::vector<Contributor> removed_drift(const Run& run);

}  // namespace mdof::algo
