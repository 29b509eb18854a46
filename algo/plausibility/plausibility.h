// Whether a run can be correct: figures about it, and notices of what looks wrong, such as missing
// visits, stops that gave no point, and quantities in other units than stated.
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
  const Sequence& sequence;  // its points are solved
  const DwellDetector::Summary& dwells;
  std::uint64_t scans_lost = 0;
  bool targets_given = false;
  double least_dwell_s = 0;  // shortest stop that is averaged
};

Plausibility plausibility(const RunToJudge& run);

// Empty: nothing looks wrong. Of many similar notices only the first ones are kept, with their
// number.
Notices visit_notices(const RunToJudge& run);
Notices unit_notices(const Rig& rig, const Plausibility& figures);
// Notices of a probe whose reading is constant while others change, of a probe with its extreme
// reading and no noise in three or more stops, of a probe without value where it was out of range,
// and of an encoder that is constant while probes change.
Notices signal_notices(const RunToJudge& run);

// A notice if a travel (m) is implausible in the encoder's unit.
std::optional<Notice> encoder_unit_notice(double travel_m);

// Stops at a target that gave no point, if there is no point of this target next to them either.
std::vector<DwellDetector::Summary::PassedOver> lost_stops(const RunToJudge& run);

}  // namespace mdof::algo
