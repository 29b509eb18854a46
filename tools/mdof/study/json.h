// Writes the result of a study as JSON, for printing and storing, and reads it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// The figures that do not depend on threads, processes, interruptions and time: an object with
// trials, seed, errors by key, bins, convergence, indices, allocations, comparison and warnings.
std::string study_figures_json(const StudyResult& result);

// The document of --json: the figures and the other facts of the calculation.
std::string study_json(const StudyResult& result, const std::string& figures_json,
                       std::optional<std::int64_t> study);

// Reads the figures. Other members of `result` do not change. `source` names the figures in error
// messages.
Status read_study_figures(std::string_view json, const std::string& source, StudyResult& result);

}  // namespace mdof::tools
