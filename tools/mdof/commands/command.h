// The commands of mdof. Each is one file in a folder beside this one, with one row: how it is
// called, what its help says, and its options. commands.inc lists them.
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
  const char* summary;  // its line in the help, without a full stop
  const char* footer;   // at the end of its own help: notes, and "Example:\n  mdof replay ..."
  Action (*declare)(CLI::App& command);  // adds its options; the action runs once they are read
  const char* section = "";              // of the help; commands.inc says which
  bool reads_all_options = false;        // of every command, as its help and completion do
};

std::vector<Command> all_commands();  // in the order of the help

// When one of the commands is called, its options are declared and `chosen` becomes what it does.
void declare_commands(CLI::App& app, Action& chosen);

}  // namespace mdof::tools
