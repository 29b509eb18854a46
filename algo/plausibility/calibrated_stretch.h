// Do the probes read where their calibration record has calibrated them? Beyond, the record's line
// is extended, and nobody has measured whether the probe follows it.
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

void widen(std::optional<ReadingSpan>& span, double reading_m);  // by a reading that is not NaN

// One for each probe that reads farther beyond its calibrated stretch than a tenth of it. [probe];
// none: it has no readings.
Notices stretch_notices(const Rig& rig, const std::vector<std::optional<ReadingSpan>>& spans);

// Over the points that have errors.
Notices stretch_notices(const Rig& rig, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
