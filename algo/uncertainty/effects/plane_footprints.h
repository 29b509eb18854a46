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

// A footprint is at the mean travel of its target, so all visits of a target share one height.
// `plane`: index in the rig; `points`: as returned by point_sensitivities().
PlaneFootprints plane_footprints(const Rig& rig, const Fixture& fixture, const Run& run,
                                 const std::vector<PointSensitivity>& points, std::size_t plane);

}  // namespace mdof::algo
