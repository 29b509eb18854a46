// Does the height map of each plane cover what the probes reach of it? Beyond its ends the rigid
// model holds the last height, which nobody measured.
#pragma once

#include <string>
#include <vector>

#include "algo/model/fixture.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// One for each plane and direction in which it does not, over target travels d from `least_m` to
// `most_m`: what it covers, what is reached and by which probes. A map of one
// coordinate in a direction is meant to be the same all along it. 50 µm beyond an end are let pass.
Notices map_notices(const Rig& rig, const Fixture& fixture, double least_m, double most_m);

// Over the points that have errors.
Notices map_notices(const Rig& rig, const Fixture& fixture,
                    const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
