// Calculates the results of mdof machine budget at one position of the axes.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "algo/machine/budget/budget.h"
#include "schema/study/study.h"

namespace mdof::tools {

inline constexpr double kBudgetCoverage = 0.95;

struct BudgetRequest {
  algo::Command at{};
  algo::MachineApproach approach = algo::MachineApproach::mean;
  std::uint64_t trials = 1'000'000, seed = 1;
  unsigned threads = 1;
  std::optional<double> target_um;  // Largest permitted position error of the tool, which must be
                                    // met with the probability kBudgetCoverage.
};

// One stage of the budget (algo::BudgetStage): measured or designed. `outputs`: position errors x,
// y, z and the length of this vector ("volume") by Monte Carlo; empty if the stage has no causes.
struct FoundStage {
  algo::BudgetModel model;
  std::vector<OutputSummary> outputs;
  double volume_p95_um = std::numeric_limits<double>::quiet_NaN();
};

// Largest factors for the standard uncertainties of the rows at which the target is still met. 0:
// the target is missed even if the rows have no uncertainty. Infinite: the target is met for any
// uncertainty.
struct FoundAllocation {
  double common_factor = 0;   // the same factor for all rows
  std::vector<double> alone;  // [row] factor for this row only
};

struct FoundMachineBudget {
  FoundStage now;                      // Stage measured, see algo::BudgetStage.
  std::optional<FoundStage> designed;  // Present if errors are measured and sources are declared.
  std::vector<algo::MeasuredError> measured;
  std::optional<FoundAllocation> allocation;
};

// The figures do not depend on the number of threads.
Result<FoundMachineBudget> find_machine_budget(const Machine& machine,
                                               const BudgetRequest& request);

}  // namespace mdof::tools
