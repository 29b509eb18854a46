// An imported run as people and scripts see it: its readings, not five errors.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schema/history_entry.h"
#include "schema/run.h"

namespace mdof::tools {

// The header's members, then "points": [{"target", "run", "direction", "position_mm", "EXX_um",
// "u":
// {"EXX_um"}}]; direction null where the file does not say.
std::string imported_json(const Run& run, const std::string& result_sha256,
                          const std::vector<HistoryEntry>& actions);
std::string imported_csv(const Run& run);
std::string imported_text(const Run& run, const std::string& result_sha256, std::size_t width,
                          bool all_warnings);

}  // namespace mdof::tools
