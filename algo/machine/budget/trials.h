// An uncertainty budget by the Monte Carlo method (JCGM 101). Each trial draws a value of every
// cause, and calculates the error of the tool with the full product of the frames.
#pragma once

#include <memory>

#include "algo/machine/budget/budget.h"
#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/instruction_set.h"

namespace mdof::algo {

// Outputs x_um, y_um, z_um (actual - nominal) and volume_um = √(x² + y² + z²). Random number q of a
// trial is for cause q. The quantities that can be scaled are the rows of the budget: if an error
// is scaled, its correlations with other errors do not change. The results have the same bits for
// any number of threads and any instruction set.
std::unique_ptr<ScalableExperiment> budget_trials(const BudgetModel& model, std::uint64_t seed,
                                                  InstructionSet set = best_instruction_set());

}  // namespace mdof::algo
