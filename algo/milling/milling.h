// Simulates a micro end mill. Calculates forces, deflection, the machined wall, and the tool offset
// that corrects the mean error of the wall. Huo et al., Modeling the influence of tool deflection
// on cutting force and surface generation in micro-milling, Micromachines 8 (2017) 188; README.md
// has the equations. SI units.
#pragma once

#include <string>
#include <vector>

#include "algo/milling/cut_turn.h"
#include "algo/milling/wall.h"

namespace mdof::algo {

struct WallFigures {
  double form_m = 0;  // largest minus smallest mean of the profiles over the depth
  double waviness_tip_m = 0, waviness_root_m = 0;
  // Mean deviation outward from the nominal wall, +: overcut.
  double offset_tip_m = 0, offset_root_m = 0, offset_mean_m = 0;
  double Ra_tip_m = 0, Ra_root_m = 0;
};

struct MillingResult {
  // Forces on the tool; x: against the feed, y: towards the wall of an up cut. `max`: largest
  // magnitude within a turn.
  double x_max_N = 0, y_max_N = 0, x_max_rigid_N = 0, y_max_rigid_N = 0;
  double x_mean_N = 0, y_mean_N = 0;
  // Largest deflection of the tip. `rigid`: calculated from the forces of a rigid tool.
  double deflection_m = 0, deflection_rigid_m = 0;
  double entry_rad = 0, exit_rad = 0;  // NaN: tooth 0 does not cut
  double power_W = 0;                  // mean
  WallFigures wall;
  int iterations = 0;
};

// Errors (check): there is no equilibrium; the deflection exceeds half of the radius.
Result<MillingResult> milling(const MillingPlan& plan);

// A correction that is added to the tool radius in the controller. The mean of the wall is then at
// the programmed position. The sign is the same for G41 and G42, because with both codes the
// distance of the tool axis from the wall is the radius.
struct WearOffset {
  double offset_m = 0;
  double u_m = 0;  // standard uncertainty, first order (GUM 5); NaN: no uncertainty declared
  struct Part {
    const MillingInput* input = nullptr;
    double contribution_m = 0;
  };
  std::vector<Part> parts;                        // largest first
  std::vector<const MillingInput*> not_declared;  // inputs other than 0 whose u is not declared
};
Result<WearOffset> wear_offset(const DeclaredMillingPlan& declared);

}  // namespace mdof::algo
