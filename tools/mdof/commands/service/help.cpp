// mdof help [COMMAND]: the same as mdof [COMMAND] --help.
#include <CLI/CLI.hpp>
#include <memory>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// App::help() prints that of the command that was called: of this one.
Status help(CLI::App* app, const std::vector<std::string>& words) {
  std::string name = app->get_name();
  for (const std::string& word : words) {
    const auto found =
        app->get_subcommands([&](const CLI::App* sub) { return sub->get_name() == word; });
    if (found.empty())
      return fail(ErrorCode::usage, "help: \"" + word + "\" is not a command of " +
                                        app->get_display_name() +
                                        "; to list the commands, use: mdof help");
    app = found.front();
    name += " " + word;
  }
  return write_out(app->get_formatter()->make_help(app, name, CLI::AppFormatMode::Normal));
}

Action declare_help(CLI::App& command) {
  const auto words = std::make_shared<std::vector<std::string>>();
  command
      .add_option("COMMAND", *words,
                  "Name of a command, such as \"replay\" or \"compensation export\"")
      ->type_name("");
  return [app = command.get_parent(), words] { return help(app, *words); };
}

}  // namespace

Command help_command() {
  return {.name = "help",
          .summary = "Print the help of mdof or of a command",
          .footer = "Example:\n  mdof help compensation export",
          .declare = declare_help,
          .reads_all_options = true};
}

}  // namespace mdof::tools
