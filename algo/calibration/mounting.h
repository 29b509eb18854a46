// Calibrates the mounting of the probes of a fixture with a target that is clamped at several small
// tilts.
//
// At each clamping the machine's axes move the target by known distances. The change of the
// readings gives the tilt of the target, and the readings of a probe over the tilts of all
// clampings give its position and zero. One weighted least-squares solution (Gauss-Newton) of the
// readings of the rigid model (algo/model/rigid.h) has these unknowns: for each probe its position
// (two components in its plane), zero, direction (two components) and scale; for each clamping the
// three angles of the target; for each traverse the offset of the target. Because of these offsets
// an axis at another position, or a slow drift between traverses, has no effect.
//
// The unknowns of the clampings are eliminated. The singular values of the remaining matrix, in
// units of the rig's prior uncertainties, show which combinations the logs determine: those that
// they determine at least twice as well as the rig. All other combinations keep the rig's values,
// and the result names them. The logs can never determine what a clamping does as well: a common
// shift of all probes of a plane along this plane, or a common change of their zeros.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/calibration/mounting.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// A stop of the traversing axis.
struct TraverseStop {
  double travel_m = 0;              // travel of the target in + of the axis, from any origin
  std::vector<double> reading_m;    // one for each probe; NaN: do not use
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
  // Vectors and matrices of all unknowns in the order of the probes: position along the two
  // directions (m), zero (m), direction (rad, towards the two vectors), scale (1). `change`: found
  // minus the rig's value; `covariance`: for the part that the logs determine; `seen`: projector
  // (unknowns x unknowns) onto this part of the true values.
  Eigen::VectorXd change;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd seen;
};
inline constexpr Eigen::Index kMountingUnknowns = 6;  // per probe

// Errors: the clampings determine no probe's position (all at one tilt, too few); the positions are
// farther from the rig's than any clamping by hand (an axis that counts the other way, exchanged
// probes); the fit does not converge.
Result<MountingFit> fit_mounting(const Rig& rig, const std::vector<Clamping>& clampings);

}  // namespace mdof::algo
