// A budget by Monte Carlo (JCGM 101): each trial draws every cause and calculates the tool by the
// full product of the frames.
#pragma once

#include <memory>

#include "algo/machine/budget/budget.h"
#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/instruction_set.h"

namespace mdof::algo {

// Outputs x_um, y_um, z_um (actual - nominal) and volume_um = √(x² + y² + z²). Draw q of a trial is
// cause q: the same bits for any number of threads and any instruction set.
std::unique_ptr<ScalableExperiment> budget_trials(const BudgetModel& model, std::uint64_t seed,
                                                  InstructionSet set = best_instruction_set());

}  // namespace mdof::algo
