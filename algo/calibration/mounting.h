// Where the probes of a fixture sit, from a target that was clamped at several small tilts.
//
// At each clamping the machine's axes move the target by known millimetres: how the readings change
// gives its tilt. Each probe's readings over the tilts of all clampings then give its place and
// zero. One weighted least-squares solution of the rigid model's readings (algo/model/rigid.h) by
// Gauss-Newton has as unknowns of each probe: place (two components on its plane), zero, direction
// (two), scale; and of each clamping the target's three angles and, for each traverse, its offset,
// so that an axis that is elsewhere, or a slow drift between traverses, has no effect.
//
// The unknowns of the clampings are eliminated; the singular values of what is left, in units of
// what the rig declares not to know, say which combinations the logs show: those they know at
// least twice as well. All others stay as the rig has them, and are named. Never shown is what a
// clamping can do as well: all probes of a plane moved together along it, or their zeros together.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/calibration/mounting.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A stop of the axis that traverses.
struct TraverseStop {
  double travel_m = 0;              // of the target along + of the axis, from any origin
  std::vector<double> reading_m;    // by probe; NaN: not to be used
  std::vector<double> u_reading_m;  // standard uncertainty
};
struct Traverse {
  Axis axis = Axis::x;
  std::vector<TraverseStop> stops;
};
struct Clamping {
  std::vector<Traverse> traverses;
};

struct MountingFit {
  MountingCalibration found;
  // Of all unknowns in the order of the probes: place along the two directions (m), zero (m),
  // direction (rad, towards the two), scale (1). As found minus the rig's; the covariance of what
  // the logs show; and the projector (unknowns x unknowns) onto that part of the true values.
  Eigen::VectorXd change;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd seen;
};
inline constexpr Eigen::Index kMountingUnknowns = 6;  // of a probe

// Errors: the clampings show no probe's place (all at one tilt, too few); the places would be
// farther from the rig's than any clamping by hand leaves them: an axis that counts the other way,
// probes exchanged; the fit does not settle.
Result<MountingFit> fit_mounting(const Rig& rig, const std::vector<Clamping>& clampings);

}  // namespace mdof::algo
