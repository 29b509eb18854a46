// Budgets of figures that are calculated from two runs.
#pragma once

#include <array>

#include "algo/iso230/squareness.h"
#include "algo/uncertainty/budget/budget.h"
#include "schema/base/result.h"
#include "schema/iso230/squareness.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Budget of EC0Y = -slope(EXY) - slope(EYX) + α (Fig. 6), with a run along Z of EB0Z or EA0Z as in
// schema/iso230/squareness.h, from budgets of the two runs at the fixture. Properties of a probe
// and the surface of a plane that both rigs have (Contributor::common_as) are common to both runs,
// and their contributions add with their signs. All other uncertainties of the rigs are taken as
// independent between the runs.
Result<Budget> squareness_budget(const Rig& rig_a, const Run& run_a, const Rig& rig_b,
                                 const Run& run_b, const SquareArtefact& artefact,
                                 const TrialsRequest& request = {});

// The same budget, then the budgets of both slopes; the budgets of the runs are calculated once, at
// `at`.
Result<std::array<Budget, 3>> squareness_and_slope_budgets(const Rig& rig_a, const Run& run_a,
                                                           const Rig& rig_b, const Run& run_b,
                                                           const SquareArtefact& artefact,
                                                           const StatedPair& at = {});

// Slope of B - slope of A of each of the two straightness errors, at the fixture:
// "EYX_parallelism_urad". Properties of a probe and the surface of a plane that both rigs have are
// common to both runs. All other uncertainties of the rigs are taken as independent. If both runs
// have the same set-up, a part of them would cancel, so u is too large rather than too small.
Result<std::array<Budget, 2>> parallelism_budgets(const Rig& rig_a, const Run& run_a,
                                                  const Rig& rig_b, const Run& run_b);

}  // namespace mdof::algo
