// The result of a calibration of a probe with an encoder as reference: the encoder of the axis that
// moves the target towards the probe (algo/calibration/sensitivity.h).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

struct SensitivityCalibration {
  std::string id;              // id of the probe
  double sensitivity_1 = 1;    // change of the reading / true displacement, by least squares
  double u_sensitivity_1 = 0;  // u of sensitivity_1; for a corrected reading see relative_u()
  // Degrees of freedom of u_sensitivity_1.
  double freedom = std::numeric_limits<double>::infinity();
  double linearity_m = 0;  // largest residual from the least-squares line
  double residual_sd_m = 0;
  double from_m = 0, to_m = 0;  // range of the readings, converted to displacements
  std::size_t stops = 0;
  // Values for the rig: the scale of a probe that reads volts, and the corrections of the remaining
  // deviations at t = raw - offset (schema/rig/rig.h, Calibration).
  std::optional<double> um_per_V;
  double offset_um = 0;
  std::vector<std::array<double, 2>> linearity;
  std::array<double, 2> calibrated_um{};  // t of the first and the last position
  std::vector<std::string> not_seen;      // sentences about effects that u does not include

  // Relative standard uncertainty of the scale of the corrected readings (u_sensitivity_ppm of a
  // rig or record): the correction divides by sensitivity_1.
  double relative_u() const { return u_sensitivity_1 / sensitivity_1; }
};

}  // namespace mdof
