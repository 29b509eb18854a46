// Where the probes of a run look at a plane of the target.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/uncertainty/effects/flatness.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// A footprint is that of the mean travel at its target: the visits of a place meet the same height.
// `plane`: place in the rig; `points`: as of point_sensitivities().
PlaneFootprints plane_footprints(const Rig& rig, const Fixture& fixture, const Run& run,
                                 const std::vector<PointSensitivity>& points, std::size_t plane);

}  // namespace mdof::algo
