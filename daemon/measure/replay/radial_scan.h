// Runs whose rig has a [scan] (schema/rig/scan.h) -> a height map of the part that was scanned.
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
  std::size_t points = 0;  // heights that were taken
  std::size_t beyond_targets =
      0;  // left out: before the first target of the run or behind its last
  std::size_t without_height = 0;  // left out: the probe, the encoder or the angle gave none
  double motion_pv_m = 0;  // what the motion of the axis had in the readings, and was taken out
  // Standard uncertainty of a height: by the scatter of the heights around it, RMS over the map;
  // and by the errors of the axis that were taken out, RMS over the targets of the run that has
  // most.
  double u_noise_m = 0, u_motion_m = 0;
  bool simulated = false;
};

// Each reading of the probe less what the five errors of its own run make it read there, by the
// rigid model, and linear between the targets: a height of the part. It stands at
// x = rho cos(angle), y = -rho sin(angle); x is along the axis at the angle 0, z along `measures`,
// rho how far the probe is from the spindle's axis towards x. Encoder, angle and probe of
// different devices are brought together in time, linearly.
//
// `pixel_m`: none: a hundredth of the diameter. Errors: a run without [scan], or with fewer than
// two targets; its log is not there any more or has changed, has no such column, or one in another
// unit; those of algo::scan_map().
Result<RadialScan> radial_scan(store::Store& store, const std::vector<std::int64_t>& runs,
                               std::optional<double> pixel_m);

}  // namespace mdof::daemon
