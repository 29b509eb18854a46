// Checks whether a run is plausible. Calculates figures of the run, and notices about probable
// mistakes: missing visits, stops without a point, and quantities in other units than stated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "schema/notice/notice.h"
#include "schema/plausibility/plausibility.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

struct RunToJudge {
  const Rig& rig;
  const Sequence& sequence;  // the errors of its points must be solved
  const DwellDetector::Summary& dwells;
  std::uint64_t scans_lost = 0;
  bool targets_given = false;
};

Plausibility plausibility(const RunToJudge& run);

// If there are many similar notices, only the first ones and one with their number are returned.
Notices visit_notices(const RunToJudge& run);
Notices unit_notices(const Rig& rig, const Plausibility& figures);
// Returns notices about
// - a probe with a constant reading while others change
// - a probe that has its largest or smallest reading without noise in three or more stops
// - a probe without a value at stops where it was out of range
// - an encoder with a constant reading while the probes change
Notices signal_notices(const RunToJudge& run);

// Returns a notice if a travel (m) is not plausible in the stated unit of the encoder.
std::optional<Notice> encoder_unit_notice(double travel_m);

// Returns the stops at a target that became no point, except for stops directly before or after a
// point of this target.
std::vector<DwellDetector::Summary::PassedOver> lost_stops(const RunToJudge& run);

}  // namespace mdof::algo
