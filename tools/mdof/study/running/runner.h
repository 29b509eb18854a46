// Runs the trials of a study on threads and on the processes of MPI, until all trials are done, the
// adaptive rule ends the study, or the user interrupts. The figures of a number of trials do not
// depend on threads, processes and interruptions.
//
//   rank 0 chooses the batches of the next round ─▶ every process runs its share, with
//   separate statistics for each thread ─▶ each process merges its statistics ─▶ at intervals,
//   rank 0 merges the statistics of all processes. Rank 0 also records the convergence and the
//   checkpoints, and applies the adaptive rule
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "algo/sensitivity/adaptive.h"
#include "algo/sensitivity/experiment.h"
#include "schema/base/result.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/study/running/checkpoint.h"
#include "tools/mdof/study/running/divided_trials.h"
#include "tools/mdof/study/running/processes.h"

namespace mdof::tools {

struct RunnerOptions {
  std::optional<std::uint64_t> trials;  // nullopt: the adaptive rule decides.
  std::optional<algo::AdaptiveTolerance> adaptive;
  double coverage = 0.95;
  unsigned threads = 1;
  bool slow = false;  // True: a trial takes milliseconds, and the threads divide each block.
  // Rank 0 calls it about every 30 s, with all trials so far.
  std::function<void(const StudyWork&)> checkpoint;
};

class StudyRunner {
 public:
  // Error: the tolerances or the coverage are invalid for the adaptive rule.
  static Result<StudyRunner> create(const algo::Experiment& experiment, RunnerOptions options,
                                    Processes& processes);
  // Continues from `state`. At the end, `state` of rank 0 contains all trials; `state` of the other
  // ranks is invalid.
  StudyState run(StudyWork& state);
  // Why the adaptive rule has not ended the study; empty: it has, or there is no rule.
  std::string not_settled() const;

 private:
  using Clock = std::chrono::steady_clock;
  using Parts = std::vector<std::optional<algo::StudyStatistics>>;  // [thread]
  using Figures = std::vector<std::vector<algo::BlockFigures>>;     // [batch][output]
  struct Round {
    std::uint64_t begin = 0, end = 0;  // batches
    bool collect = false;
  };

  StudyRunner(const algo::Experiment& experiment, RunnerOptions options, std::uint64_t batch_trials,
              Processes& processes);
  void resume(const StudyWork& state);
  Round next_round();
  bool rule_ended() const;
  std::uint64_t longest_round() const;
  void work(Round& round, StudyWork& state);
  std::uint64_t work_share(const Round& round, Parts& parts, Figures* figures, StudyWork& state);
  std::uint64_t batches_at_once(const Round& round) const;
  std::uint64_t feed_rule(const Round& round, Figures figures, StudyWork& state);
  void gather(Figures& figures) const;
  void collect(StudyWork& state);
  void note_convergence(StudyWork& state) const;
  void checkpoint(StudyWork& state);
  std::uint64_t trials_before(std::uint64_t batch) const;
  void show_progress(double batches);
  double batches_run() const;

  std::unique_ptr<DividedTrials> divided_;  // For slow trials only.
  const algo::Experiment* experiment_;
  RunnerOptions options_;
  Processes* processes_;
  std::optional<algo::AdaptiveRule> rule_;
  // Work is counted in batches. A batch has batch_trials_ trials and is one block of the statistics
  // or of the adaptive rule.
  std::uint64_t batch_trials_;
  std::optional<std::uint64_t> total_;  // batches; nullopt: no limit
  std::uint64_t done_ = 0;              // batches
  double expected_batches_ = 0;         // For the progress bar; 0: unknown.
  double batches_per_s_ = 0;            // Speed of all processes in the last round.
  bool stop_ = false;
  double elapsed_before_s_ = 0;
  Clock::time_point begin_, next_checkpoint_;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace mdof::tools
