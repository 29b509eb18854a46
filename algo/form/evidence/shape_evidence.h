// Whether the shape of two maps or their noise determines how they lie against each other.
#pragma once

#include <cstddef>

#include "algo/form/registration.h"
#include "algo/form/surface.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

// How many directions among shift x, shift y and turn the shape does not determine at this pose:
// the slopes of the two maps have nothing in common there (README.md, "Surfaces and registration").
std::size_t directions_without_shape(const SurfaceMap& a, const Surface& b, const MapPose& pose);

}  // namespace mdof::algo
