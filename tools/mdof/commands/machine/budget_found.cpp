#include "tools/mdof/commands/machine/budget_found.h"

#include <algorithm>
#include <numeric>

#include "algo/machine/budget/trials.h"
#include "algo/sensitivity/allocation.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

constexpr std::uint64_t kAllocationTrials = 400'000, kAloneTrials = 40'000;
constexpr std::uint64_t kBlocksOfAPiece = 8;

using algo::StudyStatistics;

bool go_on() {
  return true;
}

StudyStatistics run_trials(const algo::Experiment& experiment, const BudgetRequest& request) {
  const algo::StudyScale scale =
      algo::pilot_scale(experiment, std::min(request.trials, algo::kPilotTrials));
  const std::uint64_t piece = algo::block_trials(experiment) * kBlocksOfAPiece;
  const auto pieces = static_cast<std::size_t>((request.trials + piece - 1) / piece);
  std::vector<StudyStatistics> parts;
  for (unsigned w = 0; w < std::max(1u, request.threads); ++w)
    parts.emplace_back(experiment, scale);
  in_parallel(
      request.threads, pieces,
      [&](unsigned worker, std::size_t i) {
        const std::uint64_t first = i * piece;
        parts[worker].add_block(experiment, first, std::min(piece, request.trials - first));
      },
      go_on);
  for (std::size_t w = 1; w < parts.size(); ++w) parts[0].merge(parts[w]);
  return std::move(parts[0]);
}

Result<FoundStage> find_stage(const Machine& machine, const BudgetRequest& request,
                              algo::BudgetStage stage) {
  FoundStage found;
  MDOF_TRY(found.model, algo::budget_model(machine, request.at, request.approach, stage));
  if (found.model.causes.empty()) return found;
  const auto experiment = algo::budget_trials(found.model, request.seed);
  found.outputs =
      run_trials(*experiment, request).overall({kBudgetCoverage, {0.5, kBudgetCoverage}});
  found.volume_p95_um = found.outputs[3].quantiles[1].value;
  return found;
}

Result<FoundAllocation> allocate(const algo::BudgetModel& model, const BudgetRequest& request) {
  const auto experiment = algo::budget_trials(model, request.seed);
  const algo::ForEach for_each = [&](std::size_t count,
                                     const std::function<void(std::size_t)>& task) {
    in_parallel(
        request.threads, count, [&](unsigned, std::size_t i) { task(i); }, go_on);
  };
  PlannedAllocation planned;
  planned.output = "volume_um";
  planned.limit = *request.target_um;
  planned.probability = kBudgetCoverage;
  planned.trials = std::min(request.trials, kAllocationTrials);
  planned.where = "--target-um";
  FoundAllocation found;
  std::vector<std::size_t> all(model.rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  MDOF_TRY(found.common_factor, algo::largest_factor(*experiment, planned, all, for_each));
  planned.trials = std::min(request.trials, kAloneTrials);
  for (const std::size_t row : all) {
    MDOF_TRY(const double factor, algo::largest_factor(*experiment, planned, {row}, for_each));
    found.alone.push_back(factor);
  }
  return found;
}

}  // namespace

Result<FoundMachineBudget> find_machine_budget(const Machine& machine,
                                               const BudgetRequest& request) {
  FoundMachineBudget found;
  MDOF_TRY(found.now, find_stage(machine, request, algo::BudgetStage::measured));
  found.measured = algo::designed_against_measured(machine, request.at);
  if (!found.measured.empty() && !machine.sources.empty()) {
    MDOF_TRY(found.designed, find_stage(machine, request, algo::BudgetStage::designed));
  }
  if (request.target_um && !found.now.model.causes.empty()) {
    MDOF_TRY(found.allocation, allocate(found.now.model, request));
  }
  return found;
}

}  // namespace mdof::tools
