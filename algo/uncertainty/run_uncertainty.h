// The uncertainty of the five errors of each point of a run, of its noise and of what its rig
// declares.
#pragma once

#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::algo {

// Of the errors as the run states them. GUM 5.1.2: the squares of the noise and of each
// contributor's part add. Degrees of freedom of the noise: the scans of the dwell less one. What
// the rig declares and cannot be reckoned with leaves the noise alone, and `why` says so. Of some
// points of a run alone: its first point must be among them, for the drift begins there.
RunUncertainty run_uncertainty(const Rig& rig, const Run& run);

}  // namespace mdof::algo
