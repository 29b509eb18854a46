// mdof help [COMMAND]: prints mdof [COMMAND] --help; mdof help fields: describes the names of
// members and columns in results.
#include <CLI/CLI.hpp>
#include <memory>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/service/field_list.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"

namespace mdof::tools {
namespace {

Status help_fields(const std::vector<std::string>& words) {
  if (words.size() == 1) return write_out(field_list(terminal_columns()));
  for (std::size_t i = 1; i < words.size(); ++i) {
    MDOF_TRY(const std::string text, field_text(words[i], terminal_columns()));
    MDOF_CHECK(write_out(text));
  }
  return {};
}

// Finds the command that the words name and prints its help. App::help() alone would print the help
// of "mdof help".
Status help(CLI::App* app, const std::vector<std::string>& words) {
  if (!words.empty() && words.front() == "fields") return help_fields(words);
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
      .add_option(
          "COMMAND", *words,
          "Name of a command, such as \"replay\" or \"compensation export\". For the meaning of "
          "members and columns of results, give the word \"fields\" and then their names")
      ->type_name("");
  return [app = command.get_parent(), words] { return help(app, *words); };
}

}  // namespace

Command help_command() {
  return {.name = "help",
          .summary = "Print the help of mdof or of a command",
          .footer =
              "Examples:\n"
              "  mdof help compensation export\n"
              "  mdof help fields                 list the members and columns of results\n"
              "  mdof help fields EYX_um nu_eff",
          .declare = declare_help,
          .reads_all_options = true};
}

}  // namespace mdof::tools
