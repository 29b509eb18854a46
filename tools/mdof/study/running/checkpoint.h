// The state of a study, as an object and as bytes that are stored to continue the study.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// Results of the trials 0 ... trials - 1, without gaps.
struct StudyWork {
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  algo::StudyScale scale;  // Scale of the statistics.
  algo::StudyStatistics statistics;
  std::vector<Convergence> convergence;
  // The blocks that were given to the adaptive rule, in this order; the figures of each block by
  // output.
  std::vector<std::vector<algo::BlockFigures>> rule;
};
// The state of a study before its first trial.
StudyWork empty_work(const algo::Experiment& experiment, const algo::StudyScale& scale);

// Appends the figures after state.trials trials to state.convergence.
void add_convergence(StudyWork& state, double coverage);

// The same trials give the same bytes, apart from elapsed_s.
std::string checkpoint_bytes(const StudyWork& state);
// Error: the bytes are not a checkpoint of this experiment.
Result<StudyWork> parse_checkpoint(std::string_view bytes, const algo::Experiment& experiment);

}  // namespace mdof::tools
