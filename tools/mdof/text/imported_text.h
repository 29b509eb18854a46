// An imported run as text and CSV. It has readings, but not the five errors of other runs.
#pragma once

#include <cstddef>
#include <string>

#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::tools {

std::string imported_csv(const Run& run);
std::string imported_text(const Run& run, const StatedFigures& figures,
                          const std::string& result_sha256, std::size_t width, bool all_warnings);

}  // namespace mdof::tools
