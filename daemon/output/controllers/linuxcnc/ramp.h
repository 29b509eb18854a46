// The ramp with which LinuxCNC follows a COMP_FILE after a reversal of the axis, and the steps for
// which the ramp never starts. Source: compute_screw_comp in LinuxCNC's src/emc/motion/control.c
// (master).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Trim steps, m, that are not applied while the ramp is at rest. With a = MAX_ACCELERATION / 2 and
// the servo period T: a step of at most a T^2 / 2 is applied at once; the ramp starts only for a
// step above a T^2; between both the ramp keeps its velocity, which is 0.
struct UnappliedSteps {
  double above_m = 0, up_to_m = 0;

  bool holds(double step_m) const { return step_m > above_m && step_m <= up_to_m; }
};
UnappliedSteps unapplied_steps(const ExportOptions::Ramp& ramp);

// Adds notes on reversals (differences between the approaches) of `series` that the ramp of its
// axis does not apply, with position and MAX_ACCELERATION. If no ramp is known, the note gives the
// values of MAX_ACCELERATION with this effect.
void note_unapplied_reversals(const Series& series, const ExportOptions& options, Export& out);

}  // namespace mdof::controllers
