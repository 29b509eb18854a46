// From the set-ups that a command has made ready to what it prints.
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
  daemon::Consent consent;  // to a map
};

void add_output_options(CLI::App& command, OutputOptions& options);

// Separates and prints. Error (check): a map is asked for, and the gate of
// daemon/measure/gate/gate.h refuses it (set-ups that contradict each other are invalid), or more
// than offset and slope of it is unseen.
Status separate_and_print(LoadedSources loaded, const char* method, const OutputOptions& options);

}  // namespace mdof::tools
