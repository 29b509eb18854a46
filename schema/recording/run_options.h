// Options with which a stored run was evaluated, as far as a reader of its results needs them. All
// options: daemon/measure/replay/request_json.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/imported/series.h"
#include "schema/run.h"

namespace mdof {

struct RunOptions {
  bool remove_drift = false;
  bool on_the_fly = false;
  ImportedSense imported;  // of imported positioning; the command for runs of older versions
  std::vector<std::string> about;                   // statements of an imported file about itself
  std::optional<double> limit_um, limit_um_per_mm;  // limits requested at import
};
// Reads the options of a run; a missing or invalid option keeps its default.
RunOptions run_options(const RunHeader& run);

}  // namespace mdof
