// Calculates from the geometry of the rig how far the target can travel along each machine axis
// until it leaves the range of a probe, and until it touches the probe.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A probe whose distance from the target changes when an axis moves.
struct ApproachedProbe {
  std::string id;
  // Travel of the target from its nominal position to the nearer end of the range (range_um,
  // valid_um and offset_um of the probe).
  double range_m = 0;
  // Travel of the target until it touches the probe; empty: the gap at the nominal position is
  // unknown.
  std::optional<double> contact_m;
  // Direction of the axis motion in which the target approaches the probe: 1, -1. 0: unknown,
  // because the probe reads a displacement and the rig has no standoff_um.
  int towards = 0;
};

struct MotionClearance {
  Axis axis = Axis::x;
  std::vector<ApproachedProbe>
      probes;  // empty: the motion is parallel to the surfaces of all probes
};

// Returns the clearances for motions along X, Y and Z. The target starts at its nominal position
// without tilt. Errors: the errors of make_fixture().
Result<std::array<MotionClearance, 3>> motion_clearances(const Rig& rig);

// Returns for example "HAZARD: Y drives the target towards or away from the probes D, E: ..." or "X
// passes by ...".
std::string clearance_text(const MotionClearance& motion);

}  // namespace mdof::algo
