#include "tools/mdof/study/analyses.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "algo/sensitivity/allocation.h"
#include "algo/sensitivity/comparison.h"
#include "algo/sensitivity/indices.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/study/running/run_experiment.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

// Number of trials in a block. Blocks of slow trials are short, because after an interrupt the
// program waits for the blocks in progress.
std::uint64_t block_trials(const Study& study, std::uint64_t trials) {
  const std::uint64_t each = algo::sum_block_trials(trials);
  return study.slow() ? std::min(each, algo::kSlowSumBlock) : each;
}

// Number of blocks; at least two, because the standard error is calculated from the differences
// between blocks.
std::uint64_t blocks_of(std::uint64_t trials, std::uint64_t each) {
  return std::max<std::uint64_t>(2, (trials + each - 1) / each);
}

// Sums the blocks 0 ... n - 1. Each thread has its own sums, which are added at the end. nullopt:
// the user interrupted.
template <class Sums, class Make, class Add>
std::optional<Sums> sum_blocks(const char* what, unsigned threads, std::uint64_t blocks, Make make,
                               Add add) {
  std::vector<std::optional<Sums>> parts(threads);
  std::atomic<std::uint64_t> finished = 0;
  ProgressBar bar(what);
  const auto work = [&](unsigned worker, std::size_t block) {
    if (!parts[worker]) parts[worker].emplace(make());
    add(*parts[worker], block);
    ++finished;
  };
  const auto tick = [&] {
    bar.show({static_cast<double>(finished), static_cast<double>(blocks), "blocks"});
    return !Interrupt::requested();
  };
  if (in_parallel(threads, blocks, work, tick) < blocks) return std::nullopt;
  Sums all = make();
  for (const auto& part : parts)
    if (part) all.merge(*part);
  return all;
}

void warn_few_common_pixels(const char* what, std::uint64_t blocks, StudyResult& result) {
  if (blocks >= algo::kFewSumBlocks) return;
  const double uncertain = 1 / std::sqrt(2 * (static_cast<double>(blocks) - 1));
  result.warnings.push_back(std::string(what) + ": the standard errors come from only " +
                            std::to_string(blocks) + " trials and are uncertain by " +
                            std::to_string(std::lround(100 * uncertain)) + " %; use " +
                            std::to_string(algo::kFewSumBlocks) + " trials or more");
}

StudyState find_indices(const Study& study, unsigned threads, StudyResult& result) {
  using algo::SobolSums;
  const algo::ScalableExperiment& experiment = *study.scalable;
  const std::uint64_t trials = study.plan->indices->trials;
  const std::uint64_t each = block_trials(study, trials);
  const std::uint64_t blocks = blocks_of(trials, each);
  warn_few_common_pixels("indices", blocks, result);
  const auto sums = sum_blocks<SobolSums>(
      "indices", threads, blocks, [&] { return SobolSums(experiment, each); },
      [&](SobolSums& part, std::uint64_t block) { part.add_block(experiment, block); });
  if (!sums) return StudyState::interrupted;
  result.indices = sums->result();
  return StudyState::complete;
}

Result<StudyState> allocate(const Study& study, unsigned threads, StudyResult& result) {
  // After an interrupt no further task is run, and the result is discarded.
  const algo::ForEach for_each = [threads](std::size_t count, const auto& task) {
    if (Interrupt::requested()) return;
    in_parallel(
        threads, count, [&task](unsigned, std::size_t i) { task(i); },
        [] { return !Interrupt::requested(); });
  };
  for (const PlannedAllocation& planned : study.plan->allocations) {
    MDOF_TRY(Allocation found, algo::allocate(*study.scalable, planned, for_each));
    if (Interrupt::requested()) return StudyState::interrupted;
    result.allocations.push_back(std::move(found));
  }
  return StudyState::complete;
}

Result<std::unique_ptr<algo::ScalableExperiment>> other_fixture(const StudyPlan& plan) {
  if (!plan.whole_run) return algo::make_compared_experiment(plan);
  StudyPlan other = plan;
  other.rig = *plan.compare;
  return make_run_experiment(other);
}

Result<StudyState> compare(const Study& study, unsigned threads, StudyResult& result) {
  using algo::ComparisonSums;
  MDOF_TRY(const auto other, other_fixture(*study.plan));
  const std::uint64_t trials = std::min(result.trials, kMostComparedTrials);
  const std::uint64_t each = block_trials(study, trials);
  const algo::Experiment& ours = *study.scalable;
  const std::uint64_t blocks = blocks_of(trials, each);
  warn_few_common_pixels("comparison", blocks, result);
  const auto sums = sum_blocks<ComparisonSums>(
      "comparison", threads, blocks, [&] { return ComparisonSums(ours, *other, each); },
      [&](ComparisonSums& part, std::uint64_t block) { part.add_block(ours, *other, block); });
  if (!sums) return StudyState::interrupted;
  result.comparison = sums->result();
  return StudyState::complete;
}

}  // namespace

Result<StudyState> analyse(const Study& study, unsigned threads, StudyResult& result) {
  if (!study.plan) return StudyState::complete;
  StudyState end = StudyState::complete;
  if (study.plan->indices) end = find_indices(study, threads, result);
  if (end == StudyState::complete) {
    MDOF_TRY(end, allocate(study, threads, result));
  }
  if (end == StudyState::complete && study.plan->compare) {
    MDOF_TRY(end, compare(study, threads, result));
  }
  return end;
}

}  // namespace mdof::tools
