// Travel of the target along each machine axis up to the end of a probe's range and up to the probe
// itself, from the rig's geometry alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A probe that the target approaches or leaves when an axis moves.
struct ProbeInTheWay {
  std::string id;
  double range_m = 0;  // travel of the target from its nominal position to the end of the range
  // Travel up to the probe; empty: the rig has no standoff_um.
  std::optional<double> contact_m;
  // Sense of the axis in which the target approaches: 1, -1; 0: the rig does not state on which
  // side the probe is (it reads displacement and has no standoff_um).
  int towards = 0;
};

struct MotionClearance {
  Axis axis = Axis::x;
  std::vector<ProbeInTheWay> probes;  // empty: the motion is parallel to the surfaces of all probes
};

// For X, Y and Z, for a target at its nominal position, without tilt, relative to the fixture.
// Errors: those of make_fixture().
Result<std::array<MotionClearance, 3>> motion_clearances(const Rig& rig);

// "HAZARD: Y drives the target towards or away from the probes D, E: ..." or "X passes by ...".
std::string clearance_text(const MotionClearance& motion);

}  // namespace mdof::algo
