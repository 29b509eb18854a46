// Prints one trial of a study by its number.
#pragma once

#include <cstdint>

#include "schema/base/result.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// Prints the drawn inputs and the outputs, which have the same bits as within the study.
Status print_trial(const Study& study, std::uint64_t trial, bool json);

}  // namespace mdof::tools
