// The gap of a capacitance probe and the gap that its amplifier shows (algo/README.md derives it).
//
// d is the gap at the middle of the electrode, r its radius, θ the angle of the target to it and ε
// the permittivity of the air. The amplifier, calibrated on a perpendicular target in air of ε_cal,
// shows
//   d_shown = (d - k (r θ)²/(4 d)) ε_cal/ε
// A tilted target and air with a higher permittivity reduce the shown gap. m, rad.
#pragma once

#include <Eigen/Core>

#include "algo/model/fixture.h"
#include "schema/axis.h"
#include "schema/rig/effects/physics.h"

namespace mdof::algo {

// sin θ times the unit vector of the axis about which the target is tilted at a probe.
Eigen::Vector3d tilt_of(const FixtureProbe& probe, const Eigen::Matrix3d& R_MC);

// k (r θ)²/(4 d): decrease of the shown gap of a tilted target.
double tilt_excess_m(const ProbePhysics& physics, double tilt_square, double gap_m);

// The gap d of a shown gap; `permittivity_ratio` = ε/ε_cal. The inverse of the formula above.
double true_gap_m(const ProbePhysics& physics, double shown_m, double tilt_square,
                  double permittivity_ratio);

// Whether the edge of the electrode touches the target, or the gap is closed.
bool touches(const ProbePhysics& physics, double tilt_square, double gap_m);

}  // namespace mdof::algo
