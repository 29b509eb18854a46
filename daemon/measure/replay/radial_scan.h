// Runs whose rig has a [scan] (schema/rig/scan.h) -> a height map of the scanned part.
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
  std::size_t points = 0;          // number of used heights
  std::size_t beyond_targets = 0;  // left out: before the first or after the last target of the run
  std::size_t without_height = 0;  // left out: no value of the probe, the encoder or the angle
  double motion_pv_m = 0;  // peak to valley of the axis motion in the readings, which was removed
  // Standard uncertainty of a height: from the scatter of the heights around it, RMS over the map;
  // and from the removed errors of the axis, RMS over the targets of the run with the largest
  // value.
  double u_noise_m = 0, u_motion_m = 0;
  bool simulated = false;
};

// The height is the probe reading minus the reading that the five errors of its own run cause
// there, by the rigid model and linear between the targets. Its position is x = rho cos(angle), y =
// -rho sin(angle); x is along the axis at the angle 0, z along `measures`, and rho is the distance
// of the probe from the spindle's axis towards x. Encoder, angle and probe of different devices are
// interpolated linearly in time.
//
// `pixel_m`: default is a hundredth of the diameter. Errors: a run without [scan] or with fewer
// than two targets; a log that is missing, has changed, lacks a column or has it in another unit;
// those of algo::scan_map().
Result<RadialScan> radial_scan(store::Store& store, const std::vector<std::int64_t>& runs,
                               std::optional<double> pixel_m);

}  // namespace mdof::daemon
