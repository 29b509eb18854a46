#include "tools/mdof/usage.h"

#include <CLI/CLI.hpp>
#include <vector>

#include "schema/base/toml/toml_reader.h"

namespace mdof::tools {
namespace {

// The last (most specific) command on the command line.
CLI::App* innermost(CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().back();
  return app;
}

std::vector<std::string> known_words(CLI::App* command, bool options) {
  std::vector<std::string> words;
  if (options) {
    for (const CLI::Option* option : command->get_options()) {
      for (const auto& name : option->get_lnames()) words.push_back("--" + name);
    }
  } else {
    for (const CLI::App* sub : command->get_subcommands(nullptr)) words.push_back(sub->get_name());
  }
  return words;
}

std::string full_name(const CLI::App* command) {
  const CLI::App* parent = command->get_parent();
  return parent ? full_name(parent) + " " + command->get_name() : "mdof";
}

}  // namespace

std::string usage_message(CLI::App& app, const CLI::ParseError& error) {
  CLI::App* command = innermost(&app);
  const std::string help = "; see " + full_name(command) + " --help";
  const auto unknown = app.remaining(true);
  if (unknown.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) {
    std::string commands;
    for (const std::string& word : known_words(command, false))
      commands += (commands.empty() ? "" : ", ") + word;
    if (!commands.empty()) return "missing command; give one of " + commands + help;
  }
  if (unknown.empty()) return error.what() + help;
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  const bool option = word.starts_with("-");
  const std::string nearest = nearest_candidate(word, known_words(command, option));
  return std::string("unknown ") + (option ? "option" : "command or argument") + " \"" + word +
         "\"" + (nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)") + help;
}

}  // namespace mdof::tools
