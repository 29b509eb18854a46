// What a calibration of the mounting has found (algo/calibration/mounting.h).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/calibration/covariance.h"

namespace mdof {

// Uncertainties are standard ones, beside a shift of all probes of a plane together. NaN: the logs
// do not show it, and the rig does not say how well it is known.
struct MountedProbe {
  std::string id;
  Vec3 position_m{}, u_position_m{};  // in M, machine axes
  Vec3 direction{};                   // unit vector
  double u_direction_rad = 0;         // the larger of those about its two axes
  double zero_m = 0, u_zero_m = 0;    // displacement that it reads at the nominal surface
  double scale_1 = 0, u_scale_1 = 0;  // found minus 1; 0 and 0 where the rig says it is exact
  bool position_seen = false, direction_seen = false, zero_seen = false;  // by the logs
  std::size_t readings = 0;                                               // that were used
};

struct MountingCalibration {
  std::vector<MountedProbe> probes;  // in the order of the rig
  // What cannot be seen and stays as the rig has it, one sentence each.
  std::vector<std::string> not_seen;
  // How far the probes of a plane may be off together; NaN: the rig does not say.
  Vec3 u_together_m{};
  CalibrationCovariance covariance;  // of the places, directions and zeros that the logs show
  std::size_t clampings = 0, readings = 0;
  double tilt_rad = 0;  // largest angle between two clampings' tilts
  double chi_square = 0;
  int freedom = 0;
  bool explained =
      true;  // by the readings' uncertainties; else those above are widened to explain it
};

}  // namespace mdof
