// Uncertainties of the ISO 230-2 parameters of one error of a run.
#pragma once

#include <cstddef>

#include "algo/uncertainty/budget/budget.h"
#include "schema/base/result.h"
#include "schema/iso230/positioning.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// `named`: index of the error in error_names(), as in readings_of_run(). Each target and approach
// has a mean with a budget as in RunBudgets. B is the largest absolute difference of the two means
// of a target; E and M are ranges; noise makes all of them larger. M is the straightness, or the
// range of an angle, and has the U of the run's other budgets. The uncertainty of R comes from
// trials (repeatability_interval.h) of the noise of each dwell and of the declared uncertainties.
// Error: as contributors().
Result<RunPositioningUncertainty> run_positioning_uncertainty(const Rig& rig, const Run& run,
                                                              std::size_t named, bool keep_slope);

}  // namespace mdof::algo
