// Calculates what a plan requests in addition to the statistics: sensitivity indices, the
// allocation of tolerances, and the comparison with another fixture.
#pragma once

#include "schema/base/result.h"
#include "schema/study/study.h"
#include "tools/mdof/study/running/runner.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// Largest number of trials for the comparison of two fixtures. With this number the standard error
// of the ratio of their standard deviations is at most 0.2 %.
inline constexpr std::uint64_t kMostComparedTrials = std::uint64_t{1} << 18;

// Calculates indices, allocations and comparison of `result`. Adds a warning if there are too few
// trials for reliable standard errors. The figures do not depend on the number of threads.
Result<StudyState> analyse(const Study& study, unsigned threads, StudyResult& result);

}  // namespace mdof::tools
