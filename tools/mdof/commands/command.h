// The commands of mdof. Each command is one file in a folder beside this file and returns one row:
// its name, its help, and its options. commands.inc lists the commands.
#pragma once

#include <functional>
#include <vector>

#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

using Action = std::function<Status()>;

struct Command {
  const char* name;     // "replay"; "device probe" is the command `probe` of the group `device`
  const char* summary;  // One line of the help, without a full stop.
  const char* footer;   // End of the command's own help: notes, and "Example:\n  mdof replay ..."
  Action (*declare)(CLI::App& command);  // Adds the options; the action runs after they are parsed.
  const char* section = "";              // Section of the help, from commands.inc.
  bool reads_all_options = false;        // Reads the options of all commands (help and completion).
};

std::vector<Command> all_commands();  // In the order of the help.

// When a command is called, declares its options and sets `chosen` to its action.
void declare_commands(CLI::App& app, Action& chosen);

}  // namespace mdof::tools
