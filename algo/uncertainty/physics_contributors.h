// What a rig declares of its probes' physics (schema/rig/effects/physics.h), as contributors: of
// what is corrected its uncertainty, of what is known and not corrected the whole of it.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Tilt factors and linearities of the probes are independent of each other; the air is common to
// all. `points`: as of point_sensitivities(). None where the rig says nothing.
std::vector<Contributor> physics_contributors(const Rig& rig, const Solver& solver, const Run& run,
                                              const std::vector<PointSensitivity>& points);

}  // namespace mdof::algo
