// Separates the errors of the machine from the errors of the target, with the set-ups that a
// command has prepared, and prints the result.
#pragma once

#include "daemon/measure/gate/gate.h"
#include "schema/base/result.h"
#include "tools/mdof/commands/separate/separation_sources.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct OutputOptions {
  bool csv = false, json = false, rig_toml = false, despite_unseen = false, all_warnings = false;
  daemon::Consent consent;  // for the output as a height map
};

void add_output_options(CLI::App& command, OutputOptions& options);

// Separates the errors and prints the result. Errors (check): the set-ups contradict each other
// (the result is printed, but not as a height map); for a height map also:
// daemon/measure/gate/gate.h rejects the data; the map has undetermined components besides offset
// and slope.
Status separate_and_print(LoadedSources loaded, const char* method, const OutputOptions& options);

}  // namespace mdof::tools
