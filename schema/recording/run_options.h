// Those options of the evaluation of a stored run that a reader of the results needs. All options
// are in daemon/measure/replay/request_json.h.
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
  ImportedSense imported;  // sense of imported positioning; for runs of older versions, `command`
  std::vector<std::string> about;                   // what an imported file states about itself
  std::optional<double> limit_um, limit_um_per_mm;  // limits that the user requested at the import
};
// Reads the options of a run; a missing or invalid option keeps its default.
RunOptions run_options(const RunHeader& run);

}  // namespace mdof
