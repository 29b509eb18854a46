// A Point contains the averages of one dwell. A MeasuredPoint also contains the five errors that
// were calculated from the averages.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/flag/point_flag.h"

namespace mdof {

// Averages over a dwell, calculated robustly.
struct Point {
  std::int64_t begin_ns = 0, end_ns = 0;  // times of the first and the last averaged sample
  double position_m = 0;                  // mean position of the encoder
  int direction = 0;              // +1, -1: direction of the travel to this point; 0: unknown
  std::vector<double> probe_m;    // mean displacement of each probe; NaN: no value
  std::vector<double> probe_u_m;  // standard uncertainty of the mean (type A)
  std::uint64_t samples = 0;      // number of scans in the dwell
  std::vector<PointFlag> flags;   // each flag at most once

  // The following members are for checks of a whole run. They are not stored and are not part of
  // the result.
  std::vector<double> probe_sd_m;      // standard deviation of single readings, for each probe
  std::uint64_t scan_fingerprint = 0;  // algo/points/scan_fingerprint.h; 0: no fingerprint
  // Smallest and largest position between the previous point and this point; NaN if not observed.
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
  std::string reason = "not solved";  // reason if !valid
  Errors5 local{};                    // δy, δz, εx, εy, εz in the axis' local frame; m, rad
  Covariance5 covariance{};           // covariance of `local`
  // Root mean square of the residuals of the readings from the model; 0 for five probes.
  double residual_m = 0;
};

// One row of a run: a point, its target and run, and its errors.
struct MeasuredPoint {
  int target = 0;  // 1 ... m, ascending in position (ISO 230-2 index i)
  // Nominal position. If there are no nominal targets: position of the first stop at this target.
  double target_m = 0;
  int run = 0;  // 1 ... n (ISO 230-2 index j)
  Point point;
  AxisErrors errors;
};

}  // namespace mdof
