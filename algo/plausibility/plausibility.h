// Can this run be right? What was found, in figures, and what in them looks wrong, as notices:
// holes in the matrix of visits, stops that gave no point, quantities in other units than stated.
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
  const Sequence& sequence;  // its points solved
  const DwellDetector::Summary& dwells;
  std::uint64_t scans_lost = 0;
  bool targets_given = false;
  double least_dwell_s = 0;  // that a stop must last to be averaged
};

Plausibility plausibility(const RunToJudge& run);

// None: nothing looks wrong. Of many alike the first ones and their number.
Notices visit_notices(const RunToJudge& run);
Notices unit_notices(const Rig& rig, const Plausibility& figures);
// A probe that reads the same while others change, one that gives its extreme reading without
// noise in three or more stops, one that has no value where it was beyond its range, an encoder
// that stands still while probes change.
Notices signal_notices(const RunToJudge& run);

// Whether a travel (m) can be one in the encoder's unit.
std::optional<Notice> encoder_unit_notice(double travel_m);

// Stops at a target that gave no point, and beside which there is none of that target either.
std::vector<DwellDetector::Summary::PassedOver> lost_stops(const RunToJudge& run);

}  // namespace mdof::algo
