// The sensitivity of a probe in place: the approaching axis moves the target along its direction,
// and the encoder of that axis says by how much.
//
// With n the normal of the probe's plane and e the axis, a travel x is the displacement
// z = x (n·e)/(n·u) along the probe's direction u. Reading = a + g z by least squares; a correction
// is true - reading, and 0 on the line where the reading is 0: the zero stays what it is. Without a
// scale of volts the sensitivity is in the corrections, too: beyond the places they go on with the
// slope 1/g - 1 of the line up to the ends of the range.
//
// u of g is the larger of two: what the noise of the stops and the declared [encoder] u_um make of
// it, the encoder's error being one at each place however often it is visited; and what the line
// leaves of the places' means, s/√Σ(z - z̄)², with two degrees of freedom less than places.
#pragma once

#include <vector>

#include "algo/calibration/mounting.h"
#include "schema/calibration/sensitivity.h"

namespace mdof::algo {

// `rig`: without linearity and polynomial of the probe, which are found anew; the stops' readings
// are by it. Errors: fewer than three places, too short a way, an axis that does not approach, a
// sensitivity that no probe has (another unit, the other way).
Result<SensitivityCalibration> fit_sensitivity(const Rig& rig, std::size_t probe,
                                               const Traverse& traverse);

// The axis that approaches the probe's plane.
Result<Axis> approaching_axis(const Rig& rig, std::size_t probe);

}  // namespace mdof::algo
