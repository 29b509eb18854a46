// What the removal of a drift adds to the uncertainty of a run.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/run.h"

namespace mdof::algo {

// A contributor of a run from which a drift was removed, without a key of the rig, as it is seen in
// the run itself: all points share what is wrong of the drift, so that the means of many visits
// have all of it. Empty: no drift was removed.
std::vector<Contributor> removed_drift(const Run& run);

}  // namespace mdof::algo
