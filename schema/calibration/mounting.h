// The result of a mounting calibration (algo/calibration/mounting.h).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/calibration/covariance.h"

namespace mdof {

// All uncertainties are standard uncertainties. They do not include a common shift of all probes of
// a plane. NaN: the logs do not determine the value, and the rig does not declare its uncertainty.
struct MountedProbe {
  std::string id;
  Vec3 position_m{}, u_position_m{};  // in the frame M, along the machine axes
  Vec3 direction{};                   // unit vector
  double u_direction_rad = 0;         // the larger u of the two axes of rotation
  // Displacement that the probe reads at the nominal surface; 0 (the zero of the rig) if the logs
  // do not determine it.
  double zero_m = 0, u_zero_m = 0;
  // Scale minus 1; both 0 if the rig declares the scale as exact.
  double scale_1 = 0, u_scale_1 = 0;
  // true: the logs determine this value.
  bool position_seen = false, direction_seen = false, zero_seen = false;
  std::size_t readings = 0;  // number of readings used
};

struct MountingCalibration {
  std::vector<MountedProbe> probes;  // in the order of the rig
  // Sentences about values that the logs do not determine; the values of the rig are kept.
  std::vector<std::string> not_seen;
  // u of the common shift of all probes of a plane; NaN: the rig does not declare it.
  Vec3 u_together_m{};
  // Covariance of the positions, directions and zeros that the logs determine.
  CalibrationCovariance covariance;
  std::size_t clampings = 0, readings = 0;
  double tilt_rad = 0;  // largest angle between the target's orientations in two clampings
  double chi_square = 0;
  int freedom = 0;
  // true: the residuals agree with the uncertainties of the readings. false: the uncertainties
  // above are multiplied by the Birge ratio.
  bool explained = true;
};

}  // namespace mdof
