// The uncertainty of the parameters of ISO 230-2 of an error of a run.
#pragma once

#include <cstddef>

#include "algo/uncertainty/budget/budget.h"
#include "schema/base/result.h"
#include "schema/iso230/positioning.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Of the error at `named` in the order of error_names(), as readings_of_run() takes it. Each target
// and approach has a mean, whose budget is that of RunBudgets: B is the largest of the sizes of
// differences of two of them, E and M are ranges, and noise makes all of these larger. M is the
// straightness, or the range of an angle, of the run's other budgets, and has their U. R by trials
// (repeatability_interval.h) of the noise of each dwell and of what is declared.
// Error: as contributors().
Result<RunPositioningUncertainty> run_positioning_uncertainty(const Rig& rig, const Run& run,
                                                              std::size_t named, bool keep_slope);

}  // namespace mdof::algo
