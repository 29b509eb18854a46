// The words for the drift of a run.
#pragma once

#include <string>

#include "algo/drift/run_drift.h"
#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// "EYX +0.2131 ± 0.0040 µm, ECX -3.10 ± 0.12 µrad from the first point to the last (2.60 min)": of
// the body that moves; the significant ones that may be steps, or cannot be. Empty: there is none.
std::string changes_text(const RunDrift& drift, const MovingAxis& moving, bool steps);

// Of a run from which it was to be removed: what was.
Notices removal_notices(const RunDrift& drift, const MovingAxis& moving);

// Of probes that drift by more than the rig's limit over the run, highest to lowest.
Notices over_limit(const RunDrift& drift, const Rig& rig);

}  // namespace mdof::algo
