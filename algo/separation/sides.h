// Compares the turn of the target that the user states with the rigs of the set-ups.
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A probe that measures along the normal of the surface.
struct ProbeAcross {
  std::string id;
  double place_m = 0;  // its position along the normal
  double along = 1;    // +1 if it measures in the + direction of the normal, otherwise -1
};

// The probes of the rig that measure along `normal`. `probe`: only this probe; empty: all probes.
std::vector<ProbeAcross> probes_across(const Rig& rig, Axis normal, const std::string& probe);

struct SidesOfSetUp {
  std::string name;        // "run 3"
  double height_sign = 1;  // as stated (set_up.h)
  std::vector<ProbeAcross> probes;
};

// If the surface faces the opposite side, the probe is at another place along the normal, or it
// measures in the opposite direction. Otherwise it stays on its side. Returns a notice for each
// set-up whose rig contradicts the stated turn: the run was then replayed with the rig of another
// set-up, or the target was not turned as stated. Places within `match_m` are the same place.
Notices compare_sides(const std::vector<SidesOfSetUp>& set_ups, double match_m);

}  // namespace mdof::algo
