// Calibrates the sensitivity of a mounted probe: the approaching axis moves the target along the
// direction of the probe, and the encoder of this axis gives the travel.
//
// n is the normal of the probe's plane, e the axis and u the direction of the probe. A travel x
// gives the displacement z = x (n·e)/(n·u) along u. The line is reading = a + g z by least squares.
// A correction is true - reading; it is 0 where the line reads 0, so the zero does not change. If
// the rig has no scale in um/V, the corrections contain the sensitivity, too: outside the
// calibrated positions they continue with the slope 1/g - 1 to the ends of the range.
//
// u(g) is the larger of two values. The first is from the noise of the stops and the declared
// [encoder] u_um; the encoder's error is the same at each visit of a position. The second is from
// the residuals of the mean of each position, s/√Σ(z - z̄)², with (positions - 2) degrees of
// freedom.
#pragma once

#include <vector>

#include "algo/calibration/mounting.h"
#include "schema/calibration/sensitivity.h"

namespace mdof::algo {

// `rig`: without linearity and polynomial of this probe, because they are determined here; the
// readings of the stops are calculated with this rig. Errors: fewer than three positions; travel
// too short; an axis that does not approach; a sensitivity outside 0.5 to 2 (other unit, other
// direction).
Result<SensitivityCalibration> fit_sensitivity(const Rig& rig, std::size_t probe,
                                               const Traverse& traverse);

// The axis that moves the target most towards or away from the probe.
Result<Axis> approaching_axis(const Rig& rig, std::size_t probe);

}  // namespace mdof::algo
