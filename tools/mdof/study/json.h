// The result of a study as JSON, as it is printed and stored, and back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// What does not depend on threads, processes, interruptions and the time: an object with trials,
// seed, errors by key, bins, convergence, indices, allocations, comparison and warnings.
std::string study_figures_json(const StudyResult& result);

// The document of --json: the figures with what is known of the run besides.
std::string study_json(const StudyResult& result, const std::string& figures_json,
                       std::optional<std::int64_t> study);

// Reads the figures; the members of StudyResult that they do not hold stay as they are. `source` is
// what the message calls them.
Status read_study_figures(std::string_view json, const std::string& source, StudyResult& result);

}  // namespace mdof::tools
