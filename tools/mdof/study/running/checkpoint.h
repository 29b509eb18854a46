// Where a study stands, as an object and as bytes: what is stored to be continued.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// What has come of the trials 0 ... trials - 1, none left out.
struct StudyWork {
  std::uint64_t trials = 0;
  double elapsed_s = 0;
  algo::StudyScale scale;  // of the statistics
  algo::StudyStatistics statistics;
  std::vector<Convergence> convergence;
  // The blocks that the adaptive rule was fed, in their order; of each the figures by output.
  std::vector<std::vector<algo::BlockFigures>> rule;
};
// That of a study before its first trial.
StudyWork empty_work(const algo::Experiment& experiment, const algo::StudyScale& scale);

// Adds the figures as they stand after state.trials to state.convergence.
void add_convergence(StudyWork& state, double coverage);

// The same bytes for the same trials, elapsed_s aside.
std::string checkpoint_bytes(const StudyWork& state);
// Error: not bytes of this experiment's checkpoint.
Result<StudyWork> parse_checkpoint(std::string_view bytes, const algo::Experiment& experiment);

}  // namespace mdof::tools
