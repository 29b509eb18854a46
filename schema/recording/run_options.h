// What a stored run says of the options that it was evaluated with, as far as its results are read
// by them; all of them: daemon/measure/replay/request_json.h.
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
  ImportedSense imported;  // of imported positioning; one of an older version: of the command
  std::vector<std::string> about;                   // what an imported file says of itself
  std::optional<double> limit_um, limit_um_per_mm;  // that an import asked for
};
// Of options that say nothing of one, or are none: as above.
RunOptions run_options(const RunHeader& run);

}  // namespace mdof
