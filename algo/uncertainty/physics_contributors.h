// The physics of the probes that a rig declares (schema/rig/effects/physics.h), as contributors. A
// corrected effect contributes the uncertainty of its correction. A known effect that is not
// corrected contributes with its full size.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// The tilt factors and linearities of different probes are independent. The ambient conditions are
// common to all probes. `points`: result of point_sensitivities(). Empty if the rig declares no
// physics.
std::vector<Contributor> physics_contributors(const Rig& rig, const Solver& solver, const Run& run,
                                              const std::vector<PointSensitivity>& points);

}  // namespace mdof::algo
