// The points where the probes of a run measure a plane of the target.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/uncertainty/effects/flatness.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// The footprint of a probe at a target is calculated at the mean travel of the visits of the
// target. Therefore all visits of a target have the same height. `plane`: index in the rig.
// `points`: result of point_sensitivities().
PlaneFootprints plane_footprints(const Rig& rig, const Fixture& fixture, const Run& run,
                                 const std::vector<PointSensitivity>& points, std::size_t plane);

}  // namespace mdof::algo
