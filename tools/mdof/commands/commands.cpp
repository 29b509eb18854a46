#include <CLI/CLI.hpp>
#include <algorithm>
#include <cassert>
#include <memory>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"

namespace mdof::tools {

#define SECTION(title)
#define COMMAND(name) Command name##_command();
#include "tools/mdof/commands/commands.inc"
#undef COMMAND
#undef SECTION

namespace {

// A group: the word with which several commands begin, such as "device". The help lists the group
// at the place of its first command.
struct Group {
  std::string_view name;
  const char *summary, *footer;
};
constexpr Group kGroups[] = {
    {"calibrate", "Calibrate the fixture on the machine; write calibration records for the rig",
     ""},
    {"compensation", "Build, show and activate compensation tables", ""},
    {"machine", "Calculate errors of a machine at the tool: maps, diagonals, circles, budgets", ""},
    {"form",
     "Build and evaluate height maps: clamping, next cutting pass, path of a fast tool "
     "servo",
     ""},
    {"separate", "Separate the machine's error from the shape of the target", ""},
    {"encoder", "Set the position of an axis that has an incremental encoder", ""},
    {"device", "List, test and monitor the devices",
     "Examples:\n"
     "  mdof device list\n"
     "  mdof device probe capa-1 --config mdofd.toml\n"
     "The commands \"probe\" and \"monitor\" open the device themselves; stop mdofd first."},
    {"setup", "Set up the service on this computer", ""},
};

CLI::App* existing_subcommand(CLI::App& app, std::string_view name) {
  const auto found =
      app.get_subcommands([name](const CLI::App* sub) { return sub->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

CLI::App* group_of(CLI::App& app, const std::string& name, const char* section) {
  if (auto* group = existing_subcommand(app, name)) return group;
  const auto row = std::find_if(std::begin(kGroups), std::end(kGroups),
                                [&name](const Group& g) { return g.name == name; });
  assert(row != std::end(kGroups) && "kGroups has no row for this group of commands");
  auto* group = app.add_subcommand(name, row->summary)->require_subcommand(1)->group(section);
  return group->footer(row->footer);
}

CLI::App* add_command(CLI::App& app, const Command& row) {
  const std::string name = row.name;
  const std::size_t space = name.find(' ');
  if (space == std::string::npos) return app.add_subcommand(name, row.summary)->group(row.section);
  return group_of(app, name.substr(0, space), row.section)
      ->add_subcommand(name.substr(space + 1), row.summary);
}

// Makes all options reject nan and inf, which CLI11 accepts as numbers.
void refuse_nan_and_inf(CLI::App& command) {
  for (CLI::Option* option : command.get_options())
    if (option->get_type_name().starts_with("FLOAT")) option->check(finite_number());
}

}  // namespace

std::vector<Command> all_commands() {
  std::vector<Command> commands;
  const char* section = "";
  const auto add = [&](Command command) {
    command.section = section;
    commands.push_back(command);
  };
#define SECTION(title) section = title;
#define COMMAND(name) add(name##_command());
#include "tools/mdof/commands/commands.inc"
#undef COMMAND
#undef SECTION
  return commands;
}

void declare_commands(CLI::App& app, Action& chosen) {
  // Only the called command declares its options, because declaring the options of all commands
  // would take most of the start time.
  const auto options = std::make_shared<std::vector<std::function<void()>>>();
  for (const Command& row : all_commands()) {
    auto* command = add_command(app, row)->footer(row.footer);
    const auto action = std::make_shared<Action>();
    const std::size_t own = options->size();
    options->push_back([row, command, action] {
      *action = row.declare(*command);
      refuse_nan_and_inf(*command);
    });
    command->preparse_callback([options, own, all = row.reads_all_options](std::size_t) {
      for (std::size_t k = 0; k < options->size(); ++k)
        if (all || k == own) (*options)[k]();
    });
    command->callback([action, &chosen] { chosen = *action; });
  }
}

}  // namespace mdof::tools
