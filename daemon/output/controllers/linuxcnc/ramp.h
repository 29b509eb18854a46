// The ramp by which LinuxCNC follows a COMP_FILE after the axis has turned, and the steps that it
// never starts. Source: compute_screw_comp in LinuxCNC's src/emc/motion/control.c (master).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Steps of the trim, m, that stay out while the ramp is at rest. With a = MAX_ACCELERATION / 2 and
// the servo period T: a step of at most a T^2 / 2 is taken at once; the ramp starts only for a step
// above a T^2; between both it keeps its velocity, which is 0.
struct HeldSteps {
  double above_m = 0, up_to_m = 0;

  bool holds(double step_m) const { return step_m > above_m && step_m <= up_to_m; }
};
HeldSteps held_steps(const ExportOptions::Ramp& ramp);

// Notes of the reversals (difference of both approaches) of `series` that the ramps of its axis do
// not apply, with place and MAX_ACCELERATION; where no ramp is known, for which MAX_ACCELERATION
// that would be so.
void note_held_reversals(const Series& series, const ExportOptions& options, Export& out);

}  // namespace mdof::controllers
