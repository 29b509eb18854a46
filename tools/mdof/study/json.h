// Writes the result of a study as JSON for the output and the database, and reads it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// The figures of the study as a JSON object: trials, seed, errors by key, bins, convergence,
// indices, allocations, comparison and warnings. The text does not depend on the number of threads
// or processes, on interruptions, or on the time.
std::string study_figures_json(const StudyResult& result);

// The output of --json: the figures, and facts about the calculation such as its duration.
std::string study_json(const StudyResult& result, const std::string& figures_json,
                       std::optional<std::int64_t> study);

// Reads the figures. Other members of `result` do not change. `source` names the figures in error
// messages.
Status read_study_figures(std::string_view json, const std::string& source, StudyResult& result);

}  // namespace mdof::tools
