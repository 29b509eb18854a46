// How far each machine axis may move the target before it reaches the end of a probe's range, and
// to the probe itself: from the rig's geometry alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A probe to which a motion along an axis brings the target nearer, or from which it takes it away.
struct ProbeInTheWay {
  std::string id;
  double range_m = 0;  // travel of the target, from the nominal place, to the range's end
  std::optional<double> contact_m;  // and to the probe; none: the rig has no standoff_um
  // Along which sense of the axis the target comes nearer: 1, -1; 0: the rig does not say on which
  // side the probe stands (it reads displacement and has no standoff_um).
  int towards = 0;
};

struct MotionClearance {
  Axis axis = Axis::x;
  std::vector<ProbeInTheWay> probes;  // empty: the motion passes by all probes
};

// Of X, Y and Z. Of a target at its nominal place and without tilt, against the fixture. Errors:
// those of make_fixture().
Result<std::array<MotionClearance, 3>> motion_clearances(const Rig& rig);

// "HAZARD: Y drives the target towards or away from the probes D, E: ..." or "X passes by ...".
std::string clearance_text(const MotionClearance& motion);

}  // namespace mdof::algo
