// A Point is what is known of one dwell; a MeasuredPoint adds the five errors solved from it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/flag/point_flag.h"

namespace mdof {

// The robust mean of a dwell.
struct Point {
  std::int64_t begin_ns = 0, end_ns = 0;  // of the samples that were averaged
  double position_m = 0;                  // encoder mean
  int direction = 0;                      // +1, -1: sign of the travel that led here; 0 unknown
  std::vector<double> probe_m;            // mean displacement; NaN: lost
  std::vector<double> probe_u_m;          // standard uncertainty of the mean (type A)
  std::uint64_t samples = 0;              // scans in the dwell
  std::vector<PointFlag> flags;           // each at most once

  // For judging a run as a whole; neither stored nor part of the result.
  std::vector<double> probe_sd_m;      // of single readings
  std::uint64_t scan_fingerprint = 0;  // algo/points/scan_fingerprint.h; 0: none
  // How far the axis went between the point before and this one; NaN where that was not seen.
  double way_min_m = std::numeric_limits<double>::quiet_NaN();
  double way_max_m = std::numeric_limits<double>::quiet_NaN();
};

enum class Model { simplified, exact, rigid };
const char* to_string(Model model);
bool model_from(std::string_view name, Model& model);

// Five errors of the target with their covariance, stated at some point (schema/rig/reference.h).
// Starts as "not solved" and says why.
struct AxisErrors {
  bool valid = false;
  std::string reason = "not solved";  // where !valid
  Errors5 local{};                    // δy, δz, εx, εy, εz in the axis' local frame; m, rad
  Covariance5 covariance{};           // of `local`
  double residual_m = 0;  // rms of what the model leaves of the readings (0 for five probes)
};

// One row of a run: a point, its place in the sequence and its errors.
struct MeasuredPoint {
  int target = 0;       // 1 ... m, ascending in position (ISO 230-2 index i)
  double target_m = 0;  // nominal or, where none is given, where the axis first stopped for it
  int run = 0;          // 1 ... n (ISO 230-2 index j)
  Point point;
  AxisErrors errors;
};

}  // namespace mdof
