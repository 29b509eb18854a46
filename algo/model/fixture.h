// A rig in the local frame of its axis, in the form that the models use.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "schema/rig/rig.h"

namespace mdof::algo {

// The line of a probe in M and its target plane in C.
struct FixtureProbe {
  std::string id;
  Eigen::Vector3d p_MP;              // point of the line on the nominal surface; m, local frame
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
// probe. Errors: a rig that contradicts itself: a position off its plane; a direction that no plane
// or that two planes fit; one plane at two positions.
Result<Fixture> make_fixture(const Rig& rig);

// Height of a target plane above the nominal plane, at a point of the plane in C; m.
double height_at(const HeightMap& map, double first_m, double second_m);

}  // namespace mdof::algo
