// The terms that the simplified model omits, as a contributor. They are known, but not corrected.
#pragma once

#include <optional>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// For a run that was solved with Model::simplified: the contribution is the difference between the
// simplified and the exact solution of the same readings (second order: 41 nm at 559 µrad). The
// contributor has no key in the rig. Empty for other models.
std::optional<Contributor> model_contributor(const Rig& rig, const Run& run, Model model);

}  // namespace mdof::algo
