// A measured run as text, as `mdof show`, `mdof replay` and `mdof record` print it.
#pragma once

#include <cstddef>
#include <string>

#include "daemon/measure/analysis/stored_drift.h"
#include "daemon/measure/budgets.h"
#include "schema/run.h"

namespace mdof::tools {

// brief: the means at each target, the points with flags or without errors, the figures with U.
// figures: the figures for each approach and reference line, the closure, the drift; no points.
// all: all points, then the same as `figures`.
enum class Extent { brief, figures, all };

// `result_sha256` may be empty. Lines of at most `width` characters.
std::string run_text(const Run& run, const daemon::StatedRun& stated,
                     const std::string& result_sha256, std::size_t width, Extent extent,
                     bool all_warnings = false);

}  // namespace mdof::tools
