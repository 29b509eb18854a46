// The results of mdof machine budget at one command.
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
  std::optional<double> target_um;  // Target for the volume, with probability kBudgetCoverage.
};

// One stage of the budget. `outputs` are x, y, z, volume by Monte Carlo; empty without a cause.
struct FoundStage {
  algo::BudgetModel model;
  std::vector<OutputSummary> outputs;
  double volume_p95_um = std::numeric_limits<double>::quiet_NaN();
};

// Largest factors on the u of the causes with which the volume keeps the target. 0: the target is
// missed even without these causes. Infinite: the target is kept with any u.
struct FoundAllocation {
  double common_factor = 0;   // on all u in common
  std::vector<double> alone;  // by cause, on its u alone
};

struct FoundMachineBudget {
  FoundStage now;                      // With the measured errors.
  std::optional<FoundStage> designed;  // Present if errors are measured and sources are declared.
  std::vector<algo::MeasuredError> measured;
  std::optional<FoundAllocation> allocation;
};

// The figures do not depend on the number of threads.
Result<FoundMachineBudget> find_machine_budget(const Machine& machine,
                                               const BudgetRequest& request);

}  // namespace mdof::tools
