// Calculates the wall that an end mill produces from the paths of its teeth with run-out and
// deflection (Z-map).
#pragma once

#include <vector>

#include "algo/milling/cut_turn.h"

namespace mdof::algo {

// Profile of the wall at one height along the feed of one turn; the profile is periodic.
struct WallLine {
  double height_m = 0;  // from the tip
  // Deviation from the nominal wall, +: overcut; at equal steps of x.
  std::vector<double> outward_m;

  double mean_m() const;
  double waviness_m() const;  // largest minus smallest value
  double Ra_m() const;        // mean distance from the mean (ISO 21920-2)
};

// Returns the profiles at the tip, in the middle of each element and at the top of the cut.
std::vector<WallLine> wall_lines(const MillingPlan& plan, const CutTurn& turn);

}  // namespace mdof::algo
