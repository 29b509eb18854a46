// One trial of a study alone, by its number.
#pragma once

#include <cstdint>

#include "schema/base/result.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// What was drawn and what came out: the same bits as within the study.
Status print_trial(const Study& study, std::uint64_t trial, bool json);

}  // namespace mdof::tools
