// Runs the trials of a study: on threads, on the processes of MPI, until all are done, the adaptive
// rule has settled, or somebody interrupts. The figures do not depend on any of that.
//
//   rank 0 says which batches the next round has ─▶ every process works off its share, each
//   thread with statistics of its own ─▶ merged in it ─▶ now and then merged in rank 0, which keeps
//   the convergence, the checkpoints and the adaptive rule
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
  std::optional<std::uint64_t> trials;  // none: as the adaptive rule says
  std::optional<algo::AdaptiveTolerance> adaptive;
  double coverage = 0.95;
  unsigned threads = 1;
  bool slow = false;  // a trial takes milliseconds: threads share each block
  // Called about every 30 s with all trials so far. Rank 0 only.
  std::function<void(const StudyWork&)> checkpoint;
};

class StudyRunner {
 public:
  // Error: tolerances or a coverage that the adaptive rule refuses.
  static Result<StudyRunner> create(const algo::Experiment& experiment, RunnerOptions options,
                                    Processes& processes);
  // Goes on from `state`, which on rank 0 then holds all trials; on the others it is used up.
  StudyState run(StudyWork& state);
  // What kept the adaptive rule from settling, in words; "": nothing, or there is no rule.
  std::string not_settled() const;

 private:
  using Clock = std::chrono::steady_clock;
  using Parts = std::vector<std::optional<algo::StudyStatistics>>;  // one a thread
  using Figures = std::vector<std::vector<algo::BlockFigures>>;     // one a batch
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

  std::unique_ptr<DividedTrials> divided_;  // of slow trials
  const algo::Experiment* experiment_;
  RunnerOptions options_;
  Processes* processes_;
  std::optional<algo::AdaptiveRule> rule_;
  // Work is counted in batches of so many trials: a block of the statistics, or one of the rule.
  std::uint64_t batch_trials_;
  std::optional<std::uint64_t> total_;  // batches; none: no limit
  std::uint64_t done_ = 0;              // batches
  double expected_batches_ = 0;         // for the progress; 0: nobody knows
  double batches_per_s_ = 0;            // of the last round, all processes
  bool stop_ = false;
  double elapsed_before_s_ = 0;
  Clock::time_point begin_, next_checkpoint_;
  std::unique_ptr<ProgressBar> bar_;
};

}  // namespace mdof::tools
