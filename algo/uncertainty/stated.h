// Calculates the uncertainty of the points and of the figures of a run together. Both need the
// parts of all contributors, which take long to calculate.
#pragma once

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

struct StatedUncertainty {
  RunUncertainty points;       // as run_uncertainty()
  Result<RunBudgets> figures;  // as RunBudgets::create()
};
StatedUncertainty stated_uncertainty(const Rig& rig, const Run& run);

}  // namespace mdof::algo
