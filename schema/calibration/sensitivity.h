// What a calibration of a probe against the encoder of the approaching axis has found
// (algo/calibration/sensitivity.h).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

struct SensitivityCalibration {
  std::string id;            // of the probe
  double sensitivity_1 = 1;  // reading for a true displacement, by least squares
  double u_sensitivity_1 = 0;
  double freedom = std::numeric_limits<double>::infinity();  // its degrees of freedom
  double linearity_m = 0;                                    // the largest that the line leaves
  double residual_sd_m = 0;
  double from_m = 0, to_m = 0;  // readings, displacement
  std::size_t stops = 0;
  // For the rig: the scale of a probe in volts, and the corrections that are left, at t = raw -
  // offset as the rig has it (schema/rig/rig.h, Calibration).
  std::optional<double> um_per_V;
  double offset_um = 0;
  std::vector<std::array<double, 2>> linearity;
  std::array<double, 2> calibrated_um{};  // t of the first and the last place
  std::vector<std::string> not_seen;      // what is not in u, one sentence each
};

}  // namespace mdof
