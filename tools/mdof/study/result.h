// Calculates the result of a study from the state of its work.
#pragma once

#include <string>

#include "schema/study/study.h"
#include "tools/mdof/study/running/checkpoint.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// Figures of the trials so far, with the last point of the convergence. Warnings state how many
// trials were not solved.
StudyResult result_of(const Study& study, const StudyWork& state, const std::string& started_utc);

}  // namespace mdof::tools
