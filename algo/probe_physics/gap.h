// The relation between the gap of a capacitance probe and the gap that its amplifier shows
// (derivation in algo/README.md).
//
// d is the gap at the centre of the electrode, r the radius of the electrode, θ the angle between
// target and electrode, and ε the permittivity of the air. The amplifier was calibrated with a
// target perpendicular to the probe, in air with the permittivity ε_cal. It shows
//   d_shown = (d - k (r θ)²/(4 d)) ε_cal/ε
// k is the tilt factor of the probe. A tilted target and a higher permittivity reduce the shown
// gap. m, rad.
#pragma once

#include <Eigen/Core>

#include "algo/model/fixture.h"
#include "schema/axis.h"
#include "schema/rig/effects/physics.h"

namespace mdof::algo {

// Returns sin θ times the unit vector of the axis about which the target is tilted relative to a
// probe.
Eigen::Vector3d tilt_of(const FixtureProbe& probe, const Eigen::Matrix3d& R_MC);

// Returns k (r θ)²/(4 d), the decrease of the shown gap due to the tilt of the target.
double gap_decrease_by_tilt_m(const ProbePhysics& physics, double tilt_square, double gap_m);

// Returns the gap d for a shown gap (the inverse of the formula above). `permittivity_ratio` =
// ε/ε_cal.
double true_gap_m(const ProbePhysics& physics, double shown_m, double tilt_square,
                  double permittivity_ratio);

// Returns whether the edge of the electrode touches the target, or the gap is closed.
bool touches(const ProbePhysics& physics, double tilt_square, double gap_m);

}  // namespace mdof::algo
