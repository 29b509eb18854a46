// A rig in the axis' local frame, in the form in which the models use it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "schema/rig/rig.h"

namespace mdof::algo {

// A probe's line in M and the target plane in C it looks at.
struct FixtureProbe {
  std::string id;
  Eigen::Vector3d p_MP;              // point of the line on the nominal surface; m, local frame
  Eigen::Vector3d u_M;               // unit direction along which displacement counts positive
  Eigen::Vector3d n_C;               // unit normal of the target plane
  double plane_offset_m = 0;         // n · p = offset
  HeightMap flatness;                // of that plane; empty: flat
  std::optional<std::size_t> plane;  // place of that plane in the rig; none: the rig has no planes
};

struct Fixture {
  Axis axis = Axis::x;
  std::vector<FixtureProbe> probes;  // in the order of the rig
};

// Turns the rig into the axis' local frame (schema/axis.h) and finds each probe's plane. Errors: a
// rig that contradicts itself: a position off its plane, a plane that no probe's direction or two
// planes' give, one plane at two places.
Result<Fixture> make_fixture(const Rig& rig);

// Height of a target plane above its nominal, at a point of the plane in C; m.
double height_at(const HeightMap& map, double first_m, double second_m);

}  // namespace mdof::algo
