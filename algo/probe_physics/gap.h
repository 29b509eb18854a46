// The gap of a capacitance probe and what its amplifier shows of it (algo/README.md derives it).
//
// With the gap d of the electrode's middle, its radius r, the angle θ of the target to it and the
// permittivity ε of the air, the amplifier, calibrated on a square target in air of ε_cal, shows
//   d_shown = (d - k (r θ)²/(4 d)) ε_cal/ε
// A tilted target and a denser or damper air both seem nearer. m, rad.
#pragma once

#include <Eigen/Core>

#include "algo/model/fixture.h"
#include "schema/axis.h"
#include "schema/rig/effects/physics.h"

namespace mdof::algo {

// (θ × the unit vector about which the target is turned) of a probe: its square is sin²θ.
Eigen::Vector3d tilt_of(const FixtureProbe& probe, const Eigen::Matrix3d& R_MC);

// k (r θ)²/(4 d): by how much nearer a tilted target seems.
double tilt_excess_m(const ProbePhysics& physics, double tilt_square, double gap_m);

// d of what is shown; `permittivity_ratio` = ε/ε_cal. The inverse of the formula above.
double gap_of_shown_m(const ProbePhysics& physics, double shown_m, double tilt_square,
                      double permittivity_ratio);

// The electrode's edge meets the target, or the gap is closed.
bool touches(const ProbePhysics& physics, double tilt_square, double gap_m);

}  // namespace mdof::algo
