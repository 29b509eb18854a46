// Whether the probes read within the range of their calibration record. Outside, the line of the
// record is extrapolated, and it is unknown whether the probe follows it.
#pragma once

#include <optional>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Displacements of one probe, m.
struct ReadingSpan {
  double least_m = 0, most_m = 0;
};

// Extends `span` by a reading; NaN is ignored.
void widen(std::optional<ReadingSpan>& span, double reading_m);

// A notice for each probe that reads outside its calibrated range by more than a tenth of this
// range. `spans`: [probe]; empty: the probe has no readings.
Notices stretch_notices(const Rig& rig, const std::vector<std::optional<ReadingSpan>>& spans);

// For the points that have errors.
Notices stretch_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
