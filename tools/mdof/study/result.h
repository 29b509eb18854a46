// Calculates the result of a study from the statistics of its trials.
#pragma once

#include <string>

#include "schema/study/study.h"
#include "tools/mdof/study/running/checkpoint.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// The figures of the trials so far. Adds the present figures as the last point of the convergence.
// If trials were not solved, a warning states their number.
StudyResult result_of(const Study& study, const StudyWork& state, const std::string& started_utc);

}  // namespace mdof::tools
