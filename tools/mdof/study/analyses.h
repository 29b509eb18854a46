// Analyses that a plan requests in addition to the statistics: indices, tolerances, another
// fixture.
#pragma once

#include "schema/base/result.h"
#include "schema/study/study.h"
#include "tools/mdof/study/running/runner.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// Largest number of trials of a comparison; the ratio is then known to 0.2 % or better.
inline constexpr std::uint64_t kMostComparedTrials = std::uint64_t{1} << 18;

// Fills indices, allocations and comparison, and warns if the trials are too few for good standard
// errors. The figures do not depend on the number of threads.
Result<StudyState> analyse(const Study& study, unsigned threads, StudyResult& result);

}  // namespace mdof::tools
