// mdof completion SHELL: prints a script with which a shell completes commands and options.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "daemon/output/controllers/export.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// A command or group, with the words that may follow it.
struct Node {
  std::string path;  // "compensation export"; empty for mdof itself
  std::vector<const CLI::App*> below;
  std::vector<const CLI::Option*> options;
};

void collect(const CLI::App& app, const std::string& path, std::vector<Node>& nodes) {
  Node node{path, app.get_subcommands({}), {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_lnames().empty() && !option->get_group().empty())
      node.options.push_back(option);  // options without a group are former names, which are hidden
  nodes.push_back(node);
  for (const CLI::App* sub : node.below)
    collect(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), nodes);
}

std::string long_name(const CLI::Option& option) {
  return "--" + option.get_lnames().front();
}

std::string commands_after(const Node& node) {
  std::string words;
  for (const CLI::App* sub : node.below) words += sub->get_name() + " ";
  return words;
}

std::string options_after(const Node& node) {
  std::string words;
  for (const CLI::Option* option : node.options) words += long_name(*option) + " ";
  return words;
}

// The valid values of an option, such as "X Y Z"; empty: any value.
std::string values_of(const Node& node, const CLI::Option& option) {
  std::string values;
  if (node.path.starts_with("compensation ") && long_name(option) == "--format")
    for (const controllers::Format& format : controllers::formats())
      values += (values.empty() ? "" : " ") + std::string(format.name);
  const std::string type = option.get_type_name();  // "TEXT:{X,Y,Z}" for IsMember
  const std::size_t begin = type.find(":{");
  if (begin == std::string::npos || type.back() != '}') return values;
  values = type.substr(begin + 2, type.size() - begin - 3);
  std::replace(values.begin(), values.end(), ',', ' ');
  return values;
}

// The script for bash, which zsh also reads. If no word matches, the shell offers file names.
std::string bash_script(const std::vector<Node>& nodes) {
  std::string cases;
  for (const Node& node : nodes)
    cases += "    '" + node.path + "') words='" + commands_after(node) + "' options='" +
             options_after(node) + "' ;;\n";
  std::string values;
  for (const Node& node : nodes)
    for (const CLI::Option* option : node.options)
      if (const std::string words = values_of(node, *option); !words.empty())
        values += "    '" + node.path + " " + long_name(*option) + "') values='" + words + "' ;;\n";
  return "# bash completion of mdof; made by: mdof completion bash\n"
         "_mdof() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} path='' words='' options='' values='' word "
         "first=1\n"
         "  [[ COMP_CWORD -gt 1 && ${COMP_WORDS[1]} == help ]] && first=2\n"
         "  for word in \"${COMP_WORDS[@]:first:COMP_CWORD-first}\"; do\n"
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
         "  case \"$path ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  [[ -n $values ]] && words=$values options=''\n"
         "  if ((first == 2)); then\n"
         "    options=''\n"
         "    [[ -z $path ]] && words=\"$words fields\"\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words $options\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _mdof mdof\n";
}

std::string zsh_script(const std::vector<Node>& nodes) {
  return "#compdef mdof\n# zsh completion of mdof; made by: mdof completion zsh\n"
         "autoload -U +X bashcompinit && bashcompinit\n" +
         bash_script(nodes);
}

std::string quoted(std::string text) {  // in the syntax of fish
  for (std::size_t at = 0; (at = text.find_first_of("\\'", at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return "'" + text + "'";
}

std::string fish_script(const std::vector<Node>& nodes) {
  std::string script = "# fish completion of mdof; made by: mdof completion fish\n";
  for (const Node& node : nodes) {
    // The condition in fish: the user has typed each word of the path, but no command of this group
    // yet.
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
    for (const CLI::Option* option : node.options) {
      const std::string values = values_of(node, *option);
      script += line + " -l " + option->get_lnames().front() +
                (!values.empty()                        ? " -x -a " + quoted(values)
                 : option->get_items_expected_max() > 0 ? " -r"
                                                        : "") +
                " -d " + quoted(option->get_description()) + "\n";
    }
    if (node.path.empty())
      script += "complete -c mdof -n '__fish_seen_subcommand_from help' -f -a " +
                quoted(commands_after(node) + "fields") + "\n";
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
