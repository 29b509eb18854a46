// The state of a study, and its conversion to bytes (checkpoint). A stored checkpoint makes it
// possible to continue the study.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// The results of the trials 0 ... `trials` - 1; no trial is missing.
struct StudyWork {
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  algo::StudyScale scale;  // Scale of the histogram of each output.
  algo::StudyStatistics statistics;
  std::vector<Convergence> convergence;
  // [block][output] figures of the blocks that the adaptive rule has received, in this order.
  std::vector<std::vector<algo::BlockFigures>> rule;
};
// The state of a study before its first trial.
StudyWork empty_work(const algo::Experiment& experiment, const algo::StudyScale& scale);

// Appends a point with the present figures to state.convergence.
void add_convergence(StudyWork& state, double coverage);

// The bytes depend only on the trials, except elapsed_s.
std::string checkpoint_bytes(const StudyWork& state);
// Error: the bytes are not a checkpoint of this experiment.
Result<StudyWork> parse_checkpoint(std::string_view bytes, const algo::Experiment& experiment);

}  // namespace mdof::tools
