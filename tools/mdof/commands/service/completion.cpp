// mdof completion SHELL: the completion of commands and options, made of the commands themselves.
#include <CLI/CLI.hpp>
#include <memory>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// A command with what may follow it.
struct Node {
  std::string path;  // "compensation export"; of mdof itself ""
  std::vector<const CLI::App*> below;
  std::vector<const CLI::Option*> options;
};

void collect(const CLI::App& app, const std::string& path, std::vector<Node>& nodes) {
  Node node{path, app.get_subcommands({}), {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_lnames().empty()) node.options.push_back(option);
  nodes.push_back(node);
  for (const CLI::App* sub : node.below)
    collect(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), nodes);
}

std::string long_name(const CLI::Option& option) {
  return "--" + option.get_lnames().front();
}

std::string words_after(const Node& node) {
  std::string words;
  for (const CLI::App* sub : node.below) words += sub->get_name() + " ";
  for (const CLI::Option* option : node.options) words += long_name(*option) + " ";
  return words;
}

// bash and zsh: where no word fits, files are offered.
std::string bash_script(const std::vector<Node>& nodes) {
  std::string cases;
  for (const Node& node : nodes)
    cases += "    '" + node.path + "') words='" + words_after(node) + "' ;;\n";
  return "# bash completion of mdof; made by: mdof completion bash\n"
         "_mdof() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} path='' words='' word\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    [[ $word == -* ]] && break\n"
         "    case \"${path:+$path }$word\" in\n" +
         [&] {
           std::string known;
           for (const Node& node : nodes)
             if (!node.path.empty()) known += (known.empty() ? "      '" : "|'") + node.path + "'";
           return known;
         }() +
         ") path=\"${path:+$path }$word\" ;;\n"
         "      *) break ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$path\" in\n" +
         cases +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _mdof mdof\n";
}

std::string zsh_script(const std::vector<Node>& nodes) {
  return "#compdef mdof\n# zsh completion of mdof; made by: mdof completion zsh\n"
         "autoload -U +X bashcompinit && bashcompinit\n" +
         bash_script(nodes);
}

std::string quoted(std::string text) {  // for fish
  for (std::size_t at = 0; (at = text.find_first_of("\\'", at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return "'" + text + "'";
}

std::string fish_script(const std::vector<Node>& nodes) {
  std::string script = "# fish completion of mdof; made by: mdof completion fish\n";
  for (const Node& node : nodes) {
    // Each word of the path has been typed, and of a group none of its commands yet.
    std::string condition = node.path.empty() ? "__fish_use_subcommand" : "";
    for (const std::string& word : CLI::detail::split(node.path, ' '))
      if (!word.empty())
        condition += (condition.empty() ? "" : "; and ") +
                     std::string("__fish_seen_subcommand_from ") + word;
    std::string names;
    for (const CLI::App* sub : node.below) names += " " + sub->get_name();
    if (!node.path.empty() && !names.empty())
      condition += "; and not __fish_seen_subcommand_from" + names;
    const std::string line = "complete -c mdof -n " + quoted(condition);
    for (const CLI::App* sub : node.below)
      script += line + " -f -a " + sub->get_name() + " -d " + quoted(sub->get_description()) + "\n";
    for (const CLI::Option* option : node.options)
      script += line + " -l " + option->get_lnames().front() +
                (option->get_items_expected_max() > 0 ? " -r" : "") + " -d " +
                quoted(option->get_description()) + "\n";
  }
  return script;
}

Action declare_completion(CLI::App& command) {
  const auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->type_name("");
  return [app = command.get_parent(), shell] {
    std::vector<Node> nodes;
    collect(*app, "", nodes);
    return write_out(*shell == "bash"  ? bash_script(nodes)
                     : *shell == "zsh" ? zsh_script(nodes)
                                       : fish_script(nodes));
  };
}

}  // namespace

Command completion_command() {
  return {.name = "completion",
          .summary = "Print a script that completes commands and options in a shell",
          .footer =
              "Examples:\n"
              "  mdof completion bash > ~/.local/share/bash-completion/completions/mdof\n"
              "  mdof completion zsh > ~/.zfunc/_mdof\n"
              "  mdof completion fish > ~/.config/fish/completions/mdof.fish",
          .declare = declare_completion,
          .reads_all_options = true};
}

}  // namespace mdof::tools
