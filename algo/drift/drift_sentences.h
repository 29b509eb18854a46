// Sentences about the drift of a run.
#pragma once

#include <string>

#include "algo/drift/run_drift.h"
#include "schema/axis.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// "EYX +0.2131 ± 0.0040 µm, ECX -3.10 ± 0.12 µrad from the first point to the last (2.60 min)" of
// the moving body: the significant drifts that may be steps (`steps`), or those that cannot be.
// Empty: there are none.
std::string changes_text(const RunDrift& drift, const MovingAxis& moving, bool steps);

// Notices of a run whose drift removal was requested: which drifts were removed.
Notices removal_notices(const RunDrift& drift, const MovingAxis& moving);

// Notices of probes that drift by more than the rig's limit over the run (highest minus lowest).
Notices over_limit(const RunDrift& drift, const Rig& rig);

}  // namespace mdof::algo
