// The physics of the probes that a rig declares (schema/rig/effects/physics.h), as contributors: a
// corrected effect contributes the uncertainty of its correction, a known effect without correction
// contributes as a whole.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Tilt factors and linearities of the probes are independent of each other; the ambient conditions
// are common to all probes. `points`: as returned by point_sensitivities(). Empty if the rig
// declares no physics.
std::vector<Contributor> physics_contributors(const Rig& rig, const Solver& solver, const Run& run,
                                              const std::vector<PointSensitivity>& points);

}  // namespace mdof::algo
