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

// Budget of the squareness EC0Y = -slope(EXY) - slope(EYX) + α (Fig. 6), or of EB0Z or EA0Z if one
// run is along Z (schema/iso230/squareness.h), plus the effect of a tilted square, whose u is
// neglected (algo/iso230/square_tilt.h). The reference point of the errors is the origin of M. Some
// quantities are common to both runs: properties of a probe and the surface of a plane that both
// rigs have (Contributor::common_as). Their contributions to both slopes add with their signs. All
// other uncertainties of the two rigs are taken as independent.
Result<Budget> squareness_budget(const Rig& rig_a, const Run& run_a, const Rig& rig_b,
                                 const Run& run_b, const SquareArtefact& artefact,
                                 const TrialsRequest& request = {});

// The budget of the squareness, then the budgets of the two slopes. `at`: reference points of
// the errors of the two runs.
Result<std::array<Budget, 3>> squareness_and_slope_budgets(const Rig& rig_a, const Run& run_a,
                                                           const Rig& rig_b, const Run& run_b,
                                                           const SquareArtefact& artefact,
                                                           const StatedPair& at = {});

// Budgets of (slope of run B - slope of run A) for each of the two straightness errors, with the
// origin of M as reference point: "EYX_parallelism_urad". Properties of a probe and the surface of
// a plane that both rigs have are common to both runs. All other uncertainties of the two rigs are
// taken as independent. If both runs have the same set-up, some of these uncertainties cancel in
// reality, and u is too large.
Result<std::array<Budget, 2>> parallelism_budgets(const Rig& rig_a, const Run& run_a,
                                                  const Rig& rig_b, const Run& run_b);

}  // namespace mdof::algo
