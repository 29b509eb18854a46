// Checks whether the readings of the probes are within the range of the calibration record. Outside
// this range the line of the record is extrapolated, and the deviation of the probe from this line
// is unknown.
#pragma once

#include <optional>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Range of the displacements of one probe, m.
struct ReadingSpan {
  double least_m = 0, most_m = 0;
};

// Extends `span` by a reading; NaN is ignored.
void widen(std::optional<ReadingSpan>& span, double reading_m);

// Returns a notice for each probe with readings outside its calibrated range by more than a tenth
// of this range. `spans`: [probe]; empty: the probe has no readings.
Notices calibrated_range_notices(const Rig& rig,
                                 const std::vector<std::optional<ReadingSpan>>& spans);

// As above, for the readings of all points whose errors are valid.
Notices calibrated_range_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
