// Whether the height map of each plane covers the area that the probes reach. Outside, the rigid
// model holds the last height, which was not measured.
#pragma once

#include <string>
#include <vector>

#include "algo/model/fixture.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A notice for each plane and direction that the map does not cover over target travels d from
// `least_m` to `most_m`: what it covers, what is reached and by which probes. A map with one
// coordinate in a direction is constant in this direction. 50 µm outside are allowed.
Notices map_notices(const Rig& rig, const Fixture& fixture, double least_m, double most_m);

// For the points that have errors.
Notices map_notices(const Rig& rig, const Fixture& fixture,
                    const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
