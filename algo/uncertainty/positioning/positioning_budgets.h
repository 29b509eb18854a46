// Uncertainties of the ISO 230-2 parameters of one error of a run.
#pragma once

#include <cstddef>

#include "algo/uncertainty/budget/budget.h"
#include "schema/base/result.h"
#include "schema/iso230/positioning.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// `named`: index of the error in error_names(), as in readings_of_run(). B, E and M are calculated
// from the mean of each target and approach; their uncertainties are calculated as in RunBudgets:
//   B: largest absolute difference between the two means of a target
//   E: range of the means
//   M: range of the means of both approaches; U as in the other budgets of the run
// Without `keep_slope`, straightness errors are relative to their least-squares line. Noise makes
// B, E and M larger. The uncertainty of R is calculated from trials of the noise of each dwell and
// of the declared uncertainties (repeatability_interval.h). Error: as contributors().
Result<RunPositioningUncertainty> run_positioning_uncertainty(const Rig& rig, const Run& run,
                                                              std::size_t named, bool keep_slope);

}  // namespace mdof::algo
