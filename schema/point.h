// A Point holds the averages of one dwell; a MeasuredPoint adds the five errors solved from it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/flag/point_flag.h"

namespace mdof {

// Robust averages of a dwell.
struct Point {
  std::int64_t begin_ns = 0, end_ns = 0;  // first and last of the averaged samples
  double position_m = 0;                  // encoder mean
  int direction = 0;              // +1, -1: direction of the travel to this point; 0: unknown
  std::vector<double> probe_m;    // mean displacement; NaN: lost
  std::vector<double> probe_u_m;  // standard uncertainty of the mean (type A)
  std::uint64_t samples = 0;      // scans in the dwell
  std::vector<PointFlag> flags;   // each at most once

  // For checks of a whole run; neither stored nor part of the result.
  std::vector<double> probe_sd_m;      // standard deviation of single readings
  std::uint64_t scan_fingerprint = 0;  // algo/points/scan_fingerprint.h; 0: none
  // Smallest and largest position between the previous point and this one; NaN if not observed.
  double travel_min_m = std::numeric_limits<double>::quiet_NaN();
  double travel_max_m = std::numeric_limits<double>::quiet_NaN();
};

enum class Model { simplified, exact, rigid };
const char* to_string(Model model);
bool model_from(std::string_view name, Model& model);

// Five errors of the target with their covariance, at a reference point (schema/rig/reference.h).
// The initial state is "not solved".
struct AxisErrors {
  bool valid = false;
  std::string reason = "not solved";  // if !valid: why
  Errors5 local{};                    // δy, δz, εx, εy, εz in the axis' local frame; m, rad
  Covariance5 covariance{};           // of `local`
  double residual_m = 0;  // rms residual of the readings against the model (0 for five probes)
};

// One row of a run: a point, its place in the sequence and its errors.
struct MeasuredPoint {
  int target = 0;  // 1 ... m, ascending in position (ISO 230-2 index i)
  // Nominal position; without nominal targets, the position of the first stop at this target.
  double target_m = 0;
  int run = 0;  // 1 ... n (ISO 230-2 index j)
  Point point;
  AxisErrors errors;
};

}  // namespace mdof
