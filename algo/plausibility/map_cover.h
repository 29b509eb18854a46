// Checks whether the height map of each plane contains the area that the probes measure. Outside
// the map, the rigid model uses the height at the nearest edge of the map.
#pragma once

#include <string>
#include <vector>

#include "algo/model/fixture.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Returns a notice for each plane and direction in which probes measure outside the map at target
// travels d from `least_m` to `most_m`. The notice states the range of the map, the measured range
// and the probes. A map with one coordinate in a direction is constant in this direction. Up to 50
// µm outside are allowed.
Notices map_notices(const Rig& rig, const Fixture& fixture, double least_m, double most_m);

// As above, for the travels of all points whose errors are valid.
Notices map_notices(const Rig& rig, const Fixture& fixture,
                    const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
