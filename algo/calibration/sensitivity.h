// Calibrates the sensitivity of a mounted probe. An axis moves the target towards the probe or away
// from it. The encoder of this axis measures the travel.
//
// n is the normal of the plane that the probe measures, e the direction of the axis, u the
// direction of the probe. A travel x causes the displacement z = x (n·e)/(n·u) along u. The line
// reading = a + g z is fitted by least squares; g is the sensitivity. A correction is true
// displacement - reading. The correction is 0 where the line has the reading 0, so that the
// correction does not change the zero. If the rig has no um_per_V, the corrections also contain the
// sensitivity. They are then extended to the ends of the probe's range with the slope 1/g - 1. All
// stops at one position have one correction, which is calculated from their mean. Otherwise the
// backlash between the approaches would cause a saw-tooth of corrections.
//
// u(g) is the larger one of two values:
//   - from the noise of the stops and the declared [encoder] u_um; the error of the encoder is the
//     same at each visit of a position
//   - from the residuals of the means of the positions: s/√Σ(z - z̄)², with (number of positions -
//     2) degrees of freedom
#pragma once

#include <vector>

#include "algo/calibration/mounting.h"
#include "schema/calibration/sensitivity.h"

namespace mdof::algo {

// `rig`: must not contain linearity or polynomial of this probe, because they are determined here.
// The readings of the stops must be calculated with the same rig. Errors: fewer than three
// positions; a travel that is too short, or an axis that does not move the target towards the
// probe; a sensitivity outside 0.5 to 2, for the whole traverse (wrong unit or wrong direction) or
// for one step (the probe is at the end of its range).
Result<SensitivityCalibration> fit_sensitivity(const Rig& rig, std::size_t probe,
                                               const Traverse& traverse);

// The axis that moves the target most towards or away from the probe.
Result<Axis> approaching_axis(const Rig& rig, std::size_t probe);

}  // namespace mdof::algo
