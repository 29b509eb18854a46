// Statistics of any number of trials in constant memory. Every figure is a sum of integers, a
// minimum or a maximum. So trials may be added in any order, by any number of threads, processes
// and continued runs, and give the same bits.
//
// For each bin and output: min, max, counts; power sums of cells of 512 trials, added in a fixed
// order within the cell and as 128-bit fixed-point numbers across cells; a histogram of 8192 equal
// bins over a core that a pilot determines, and beyond it bins that grow by 1/64 of the distance,
// up to the largest double. README.md has the error bounds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algo/sensitivity/adaptive.h"
#include "algo/sensitivity/experiment.h"
#include "algo/sensitivity/statistics/quantile.h"
#include "schema/base/instruction_set.h"
#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::algo {

// The core of each output's histogram, from a pilot.
using StudyScale = std::vector<OutputScale>;

// Runs the experiment's first trials as the pilot: 1024, or all trials of a smaller study. The
// result is the same on every machine.
inline constexpr std::uint64_t kPilotTrials = 1024;  // few: a trial may be a whole simulated run
StudyScale pilot_scale(const Experiment& experiment, std::uint64_t trials = kPilotTrials);

// Number of trials of one block: the least multiple of 512 times the bins that is at least `least`
// (10^4: JCGM 101 §7.9.4). A study may be divided only at such multiples; its last block may be
// shorter.
std::uint64_t block_trials(const Experiment& experiment, std::uint64_t least = 10'000);

// Recommended number of blocks for one add_block() call if trials are cheap: the histograms then
// stay in the cache. 64 blocks take about 5 ms with a preset.
inline constexpr std::uint64_t kBlocksAtOnce = 64;

// Contents of every OutputSummary.
struct SummaryRequest {
  double coverage = 0.95;
  std::vector<double> quantiles = {0.025, 0.25, 0.5, 0.75, 0.975};  // ascending
};

class StudyStatistics {
 public:
  // `shape`: only its outputs and bins are used.
  StudyStatistics(const Experiment& shape, StudyScale scale,
                  InstructionSet set = best_instruction_set());
  ~StudyStatistics();
  StudyStatistics(StudyStatistics&&) noexcept;
  StudyStatistics& operator=(StudyStatistics&&) noexcept;

  // Runs trials first_trial ... first_trial + trials - 1 and adds them. first_trial must be a
  // multiple of block_trials(experiment, 1), and so must trials, except at the end of a study. Not
  // thread-safe: use one object for each thread.
  void add_block(const Experiment& experiment, std::uint64_t first_trial, std::uint64_t trials);
  // The same; returns the figures of these trials alone, by exact order statistics.
  std::vector<BlockFigures> add_block_with_figures(const Experiment& experiment,
                                                   std::uint64_t first_trial, std::uint64_t trials,
                                                   double coverage);

  // Asserts that both have the same outputs, bins and scale (matches()).
  void merge(const StudyStatistics& other);
  bool matches(const StudyStatistics& other) const;

  // All data as bytes, for a checkpoint or another process; the same bits for the same trials.
  std::string serialise() const;
  // Checks every length and count. Error: what is wrong. `shape`: as for the constructor.
  static Result<StudyStatistics> parse(std::string_view bytes, const Experiment& shape,
                                       InstructionSet set = best_instruction_set());

  std::uint64_t trials() const;  // added, solved or not
  // Over all bins, one summary for each output.
  std::vector<OutputSummary> overall(const SummaryRequest& request = {}) const;
  // One element for each bin, without histograms for drawing; empty if results have no bins.
  std::vector<StudyBin> bins(const SummaryRequest& request = {}) const;

  std::size_t memory_bytes() const;  // memory in use now

 private:
  struct Parts;
  explicit StudyStatistics(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::algo
