// Separates the set-ups that a command has prepared, and prints the result.
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
  daemon::Consent consent;  // consent to a map
};

void add_output_options(CLI::App& command, OutputOptions& options);

// Separates and prints. Error (check): a map is requested, but daemon/measure/gate/gate.h refuses
// it (contradictory set-ups are invalid), or the map has an undetermined part besides offset and
// slope.
Status separate_and_print(LoadedSources loaded, const char* method, const OutputOptions& options);

}  // namespace mdof::tools
