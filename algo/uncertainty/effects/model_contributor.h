// The terms that the simplified model leaves out, as a contributor: they are known but not
// corrected.
#pragma once

#include <optional>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// For a run by `simplified`: the difference from the exact solution of the same readings, at the
// run's own angles, as a whole with its sign (second order: 41 nm at 559 µrad). It has no key in
// the rig. Other models have no such contributor.
std::optional<Contributor> model_contributor(const Rig& rig, const Run& run, Model model);

}  // namespace mdof::algo
