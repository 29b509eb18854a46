// A rig converted to the local frame of its axis. The models use this form.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "schema/rig/rig.h"

namespace mdof::algo {

// The measuring line of a probe in the frame M, and its target plane in the frame C.
struct FixtureProbe {
  std::string id;
  // Intersection of the line with the nominal surface; m, local frame.
  Eigen::Vector3d p_MP;
  Eigen::Vector3d u_M;               // unit vector of positive displacement
  Eigen::Vector3d n_C;               // unit normal of the target plane
  double plane_offset_m = 0;         // n · p = offset
  HeightMap flatness;                // height map of this plane; empty: flat
  std::optional<std::size_t> plane;  // index of this plane in the rig; empty: the rig has no planes
};

struct Fixture {
  Axis axis = Axis::x;
  std::vector<FixtureProbe> probes;  // in the order of the rig
};

// Converts the rig to the local frame of the axis (schema/axis.h) and finds the plane of each
// probe. Errors:
// - the position of a probe is not on its plane
// - no plane, or more than one plane, fits the direction of a probe
// - one plane is at two positions
Result<Fixture> make_fixture(const Rig& rig);

// Returns the height of a target plane above the nominal plane at a point of the plane in C; m.
double height_at(const HeightMap& map, double first_m, double second_m);

}  // namespace mdof::algo
