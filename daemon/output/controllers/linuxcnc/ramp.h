// After a reversal of an axis, LinuxCNC changes the trim of a COMP_FILE by a ramp. For some sizes
// of the trim step this ramp never starts. Source: compute_screw_comp in LinuxCNC's
// src/emc/motion/control.c (master).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// The sizes of a trim step, m, that LinuxCNC does not apply if the velocity of the ramp is 0: above
// above_m, up to up_to_m. With a = MAX_ACCELERATION / 2 and the servo period T:
// - step <= a T^2 / 2: LinuxCNC applies the step at once.
// - a T^2 / 2 < step <= a T^2: the ramp keeps its velocity, which is 0, and the step is not
// applied.
// - step > a T^2: the ramp starts.
struct UnappliedSteps {
  double above_m = 0, up_to_m = 0;

  bool holds(double step_m) const { return step_m > above_m && step_m <= up_to_m; }
};
UnappliedSteps unapplied_steps(const ExportOptions::Ramp& ramp);

// Adds a note to `out` if the ramp does not apply the reversal (difference between the approaches)
// at a position of `series`. The note states the position with the largest such reversal, and
// MAX_ACCELERATION. If no ramp of the axis is known, the note states the values of MAX_ACCELERATION
// that have this effect.
void note_unapplied_reversals(const Series& series, const ExportOptions& options, Export& out);

}  // namespace mdof::controllers
