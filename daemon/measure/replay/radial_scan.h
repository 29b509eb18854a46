// Calculates the height map of a scanned workpiece from runs whose rig has a table [scan]
// (schema/rig/scan.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::daemon {

struct RadialScan {
  SurfaceMap map;
  double pixel_m = 0;
  std::size_t points = 0;  // number of heights in the map
  // Number of heights before the first target or after the last target that the axis approached in
  // the direction of the height; they are not in the map.
  std::size_t beyond_targets = 0;
  // Number of heights in a direction of the axis in which fewer than three targets have errors; not
  // in the map.
  std::size_t other_direction = 0;
  // Number of heights without a value of the encoder or the angle; not in the map.
  std::size_t unplaced_heights = 0;
  // Peak to valley of the readings that the errors of the axis cause; these readings were
  // subtracted.
  double motion_pv_m = 0;
  // Standard uncertainties of a height, RMS over the map. u_noise_m: from the scatter of
  // neighbouring heights. From the subtracted errors of the axis (for several runs, the largest
  // value): u_motion_m, from the uncertainty of the errors at the targets; u_between_m, from their
  // interpolation between the targets (algo/compensation/between_targets.h).
  double u_noise_m = 0, u_motion_m = 0, u_between_m = 0;
  bool simulated = false;
};

// The height is the reading of the scanning probe minus the reading that the five errors of the
// same run cause. The rigid model calculates the reading from the errors at each target; between
// targets this reading is interpolated linearly. Only targets count that the axis approached in the
// direction in which it moved at the time of the height. The position of a height in the frame of
// the workpiece is
//   x = rho cos(angle), y = -rho sin(angle).
// At the angle 0, x is along the axis of the run. z is along `measures` of the scanning probe. rho
// is the distance of the probe from the axis of the spindle, positive towards x. Encoder and angle
// are interpolated linearly in time to the times of the probe. These are the recorded times minus
// the delay of the probe.
//
// `pixel_m`: default is a hundredth of the diameter of the scan. Errors:
//   - the rig of a run has no [scan], or a run has fewer than three targets with errors in each
//     direction;
//   - a log is missing or has changed, or a column is missing or has another unit;
//   - those of algo::scan_map().
Result<RadialScan> radial_scan(store::Store& store, const std::vector<std::int64_t>& runs,
                               std::optional<double> pixel_m);

}  // namespace mdof::daemon
