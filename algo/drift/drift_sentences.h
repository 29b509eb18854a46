// Sentences about the drift of a run.
#pragma once

#include <string>
#include <vector>

#include "algo/drift/run_drift.h"
#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Returns a text with the significant drifts of the moving body, for example "EYX +0.2131 ± 0.0040
// µm, ECX -3.10 ± 0.12 µrad from the first point to the last (2.60 min)". `steps`: true: only
// drifts that may be steps; false: only drifts that cannot be steps. Empty: there is no such drift.
std::string changes_text(const RunDrift& drift, const MovingAxis& moving, bool steps);

// Returns notices of a run for which drift removal was requested. The notices state which drifts
// were removed.
Notices removal_notices(const RunDrift& drift, const MovingAxis& moving);

// Returns a notice if significant changes that were not removed (`is_removed`: not subtracted,
// because they may be steps) have an effect on reversal values. `points`: as measured.
Notices reversal_notices(const DriftOfRun& drift, const std::vector<MeasuredPoint>& points,
                         const MovingAxis& moving, bool is_removed);

// Returns notices of probes whose drift during the run (highest minus lowest value) exceeds the
// limit of the rig.
Notices over_limit(const RunDrift& drift, const Rig& rig);

}  // namespace mdof::algo
