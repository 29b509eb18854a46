// Calibrates positions, directions and zeros of the probes of a fixture, with a target that is
// clamped at several small tilts.
//
// In each clamping the axes of the machine move the target by known distances. The changes of the
// readings determine the tilt of the target in this clamping. The readings of a probe at all tilts
// determine position and zero of the probe. The readings of the rigid model (algo/model/rigid.h)
// are fitted by weighted least squares (Gauss-Newton). Unknowns:
//   each probe     position along its target plane (two components), zero, direction (two
//                  components), scale
//   each clamping  three angles of the target
//   each traverse  offsets δy and δz of the target
// Because of these offsets, the position of the other axes and a slow drift between traverses have
// no effect.
//
// The unknowns of clampings and traverses are eliminated. The singular values of the remaining
// matrix, in units of the prior uncertainties of the rig, show how well the logs determine each
// combination of the unknowns of the probes. A combination is used if the logs determine it at
// least twice as well as the rig. All other combinations keep the values of the rig, and the result
// lists them. Some combinations have the same effect on the readings as a different clamping, so
// the logs cannot determine these combinations: a common shift of all probes of a plane along this
// plane, and a common change of the zeros of these probes.
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
  double travel_m = 0;  // travel of the target in the + direction of the axis, from any origin
  std::vector<double> reading_m;    // one for each probe; NaN: not used
  std::vector<double> u_reading_m;  // standard uncertainty of each reading
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
  // Vectors and matrices of the unknowns of all probes. Order for each probe: position along two
  // vectors (m), zero (m), tilt of the direction towards two vectors (rad), relative change of the
  // scale (1).
  //   change      found value - value of the rig
  //   covariance  covariance of the part that the logs determine
  //   seen        projector (unknowns x unknowns) onto the part that the logs determine
  Eigen::VectorXd change;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd seen;
};
inline constexpr Eigen::Index kMountingUnknowns = 6;  // per probe

// Errors:
//   - the clampings do not determine the position of any probe (too few clampings or equal tilts)
//   - a position is so far from the position in the rig that clamping by hand cannot be the cause
//     (wrong direction of an axis, exchanged probes)
//   - no mounting explains the readings
//   - the fit does not converge
Result<MountingFit> fit_mounting(const Rig& rig, const std::vector<Clamping>& clampings);

}  // namespace mdof::algo
