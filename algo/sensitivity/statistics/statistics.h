// Statistics of any number of trials in constant memory. All stored values are sums of integers,
// minima or maxima. Therefore the results have the same bits for any order of the trials, and for
// any number of threads, processes or continued runs.
//
// Stored values for each output in each bin of the binned quantity:
//   - minimum, maximum, number of trials
//   - power sums of cells of 512 trials. The trials of a cell are added in a fixed order; the cells
//     are added as 128-bit fixed-point numbers
//   - a histogram with 8192 equal bins over a core that the pilot determines. Outside the core, the
//     width of a bin is about 1/64 of its distance from the core, but at least the width of a bin
//     of the core, up to the largest double
// README.md has the error bounds.
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

// The core of the histogram of each output, from a pilot.
using StudyScale = std::vector<OutputScale>;

// Runs the first trials of the experiment as the pilot: 1024, or all trials of a smaller study. The
// result is the same on every computer.
inline constexpr std::uint64_t kPilotTrials = 1024;  // a small number, because one trial may be a
                                                     // whole simulated run
StudyScale pilot_scale(const Experiment& experiment, std::uint64_t trials = kPilotTrials);

// Number of trials of one block: the smallest multiple of 512 times the number of bins that is at
// least `least` (10^4: JCGM 101 §7.9.4). A study may be divided only at multiples of 512 times the
// number of bins. The last block may be shorter.
std::uint64_t block_trials(const Experiment& experiment, std::uint64_t least = 10'000);

// Recommended number of blocks for one call of add_block() if a trial is fast, because the
// histograms then stay in the cache. 64 blocks of a simulation of the paper take about 5 ms.
inline constexpr std::uint64_t kBlocksAtOnce = 64;

// Requested contents of every OutputSummary.
struct SummaryRequest {
  double coverage = 0.95;
  std::vector<double> quantiles = {0.025, 0.25, 0.5, 0.75, 0.975};  // ascending
};

class StudyStatistics {
 public:
  // `shape`: an experiment with the outputs and bins of the study.
  StudyStatistics(const Experiment& shape, StudyScale scale,
                  InstructionSet set = best_instruction_set());
  ~StudyStatistics();
  StudyStatistics(StudyStatistics&&) noexcept;
  StudyStatistics& operator=(StudyStatistics&&) noexcept;

  // Runs and adds the trials first_trial ... first_trial + trials - 1. first_trial must be a
  // multiple of block_trials(experiment, 1). `trials` must also be such a multiple, except at the
  // end of a study. Not thread-safe; use one object for each thread.
  void add_block(const Experiment& experiment, std::uint64_t first_trial, std::uint64_t trials);
  // As add_block(). Also returns the figures of these trials only, by exact order statistics.
  std::vector<BlockFigures> add_block_with_figures(const Experiment& experiment,
                                                   std::uint64_t first_trial, std::uint64_t trials,
                                                   double coverage);

  // Adds the data of `other`. matches(other) must be true: same outputs, bins and scale.
  void merge(const StudyStatistics& other);
  bool matches(const StudyStatistics& other) const;

  // All data as bytes, for a checkpoint or another process. The same trials have the same bytes.
  std::string serialise() const;
  // Reads the bytes of serialise(), and checks every length and count. `shape`: as in the
  // constructor.
  static Result<StudyStatistics> parse(std::string_view bytes, const Experiment& shape,
                                       InstructionSet set = best_instruction_set());

  std::uint64_t trials() const;  // number of added trials, including trials without solution
  // One summary for each output, over all bins.
  std::vector<OutputSummary> overall(const SummaryRequest& request = {}) const;
  // One element for each bin, without histograms for drawing; empty if results have no bins.
  std::vector<StudyBin> bins(const SummaryRequest& request = {}) const;

  std::size_t memory_bytes() const;  // memory that is used at present

 private:
  struct Parts;
  explicit StudyStatistics(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::algo
