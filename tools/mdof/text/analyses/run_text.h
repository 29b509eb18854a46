// A measured run as text, as `mdof show`, `mdof replay` and `mdof record` print it.
#pragma once

#include <cstddef>
#include <string>

#include "daemon/measure/analysis/stored_drift.h"
#include "daemon/measure/budgets.h"
#include "schema/run.h"

namespace mdof::tools {

enum class Extent {
  brief,    // means by target, points with flags or without errors, figures with U
  figures,  // figures by approach and reference line, closure, drift; no points
  all,      // all points, then as `figures`
};

// `result_sha256` may be empty. Lines of at most `width` characters.
std::string run_text(const Run& run, const daemon::StatedRun& stated,
                     const std::string& result_sha256, std::size_t width, Extent extent,
                     bool all_warnings = false);

}  // namespace mdof::tools
