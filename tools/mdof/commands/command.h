// The commands of mdof. Each command has one .cpp file in a folder beside this file; a function in
// it returns the Command. commands.inc lists these functions.
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
  const char* summary;  // One line for the list of commands, without a full stop.
  const char* footer;   // End of the command's help: notes, and "Example:\n  mdof replay ..."
  Action (*declare)(CLI::App& command);  // Adds the options. Returns the function that runs after
                                         // mdof has read them.
  const char* section = "";              // Section of the help, from commands.inc.
  // The command reads the options of all commands (help and completion).
  bool reads_all_options = false;
};

std::vector<Command> all_commands();  // In the order of the help.

// Declares all commands. When the user calls a command, its options are declared and `chosen`
// becomes its action.
void declare_commands(CLI::App& app, Action& chosen);

}  // namespace mdof::tools
