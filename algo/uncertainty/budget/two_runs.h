// Budgets of figures that are made of two runs.
#pragma once

#include <array>

#include "algo/iso230/squareness.h"
#include "algo/uncertainty/budget/budget.h"
#include "schema/base/result.h"
#include "schema/iso230/squareness.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// EC0Y = -slope(EXY) - slope(EYX) + α (Fig. 6), with a run along Z EB0Z or EA0Z as
// schema/iso230/squareness.h has them, of budgets of the two runs at the fixture. What goes with a
// probe and the surface of a plane that both rigs have (Contributor::common_as) are common to both
// runs and add with their signs; all else that the rigs declare is taken as independent between
// them.
Result<Budget> squareness_budget(const Rig& rig_a, const Run& run_a, const Rig& rig_b,
                                 const Run& run_b, const SquareArtefact& artefact,
                                 const TrialsRequest& request = {});

// The same, then those of both slopes, of one set of budgets of the runs, stated at `at`.
Result<std::array<Budget, 3>> squareness_and_slope_budgets(const Rig& rig_a, const Run& run_a,
                                                           const Rig& rig_b, const Run& run_b,
                                                           const SquareArtefact& artefact,
                                                           const StatedPair& at = {});

// slope of B - slope of A of each of the two straightness errors, at the fixture:
// "EYX_parallelism_urad". What goes with a probe and the surface of a plane that both rigs have are
// common to both runs; all else that the rigs declare is taken as independent; where it is the same
// set-up, that part would cancel, and u is too large rather than too small.
Result<std::array<Budget, 2>> parallelism_budgets(const Rig& rig_a, const Run& run_a,
                                                  const Rig& rig_b, const Run& run_b);

}  // namespace mdof::algo
