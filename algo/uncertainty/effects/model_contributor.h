// What the simplified model leaves out, as a contributor: it is known, and not corrected.
#pragma once

#include <optional>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Of a run by `simplified`: the difference from the exact solution of the same readings, at the
// run's own angles, whole and with its sign (second order: 41 nm at 559 µrad). No key of the rig is
// behind it. None of other models.
std::optional<Contributor> model_contributor(const Rig& rig, const Run& run, Model model);

}  // namespace mdof::algo
