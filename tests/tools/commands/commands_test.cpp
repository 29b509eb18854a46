#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "tools/mdof/commands/command.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

// The name of a command's source file: "device probe" gives device_probe, "iso230-2" gives
// iso230_2.
std::string file_name_of(std::string command) {
  for (char& c : command)
    if (c == ' ' || c == '-') c = '_';
  return command;
}

// The commands that the source files define, each with its file: {device_probe: device_probe.cpp}.
std::map<std::string, std::string> defined_commands() {
  const fs::path root = fs::path(MDOF_TEST_DATA).parent_path().parent_path();
  const std::regex definition("Command (\\w+)_command\\(\\)");
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tools/mdof/commands")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    const std::string text(std::istreambuf_iterator<char>(in), {});
    for (std::sregex_iterator found(text.begin(), text.end(), definition), end; found != end;
         ++found)
      files[(*found)[1]] = entry.path().filename();
  }
  return files;
}

TEST(Commands, SourceFilesMatchTheRowsOfTheCommandList) {
  std::map<std::string, std::string> rows;
  for (const Command& row : all_commands())
    rows[file_name_of(row.name)] = file_name_of(row.name) + ".cpp";
  EXPECT_EQ(rows, defined_commands());
}

TEST(Commands, EachCommandIsCalledByItsName) {
  for (const Command& row : all_commands()) {
    CLI::App app("", "mdof");
    Action chosen;
    declare_commands(app, chosen);
    EXPECT_THROW(app.parse(std::string(row.name) + " --help"), CLI::CallForHelp) << row.name;
    EXPECT_NE(app.help().find(row.summary), std::string::npos) << row.name;
  }
}

// The error message for this value of the option; empty if the value is accepted.
std::string reported(const Command& row, const CLI::Option& option, const std::string& value) {
  CLI::App app("", "mdof");
  Action chosen;
  declare_commands(app, chosen);
  std::string words = std::string(row.name) + " " + option.get_name();
  for (int i = 0; i < option.get_items_expected_min(); ++i) words += " " + value;
  try {
    app.parse(words);
  } catch (const CLI::RequiredError&) {
    return "";  // this error is about another option
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(Commands, EachNumberIsFiniteAndItsLimitsAreReadable) {
  const std::regex many_digits("\\d{30}");
  int numbers = 0;
  for (const Command& row : all_commands()) {
    if (std::string(row.name) == "sensitivity") continue;  // this command checks its numbers itself
    CLI::App app("", "mdof");
    row.declare(app);
    for (const CLI::Option* option : app.get_options()) {
      const std::string name = std::string(row.name) + " " + option->get_name();
      for (const char* value : {"-1", "1e300"})
        EXPECT_FALSE(std::regex_search(reported(row, *option, value), many_digits))
            << name << ": " << reported(row, *option, value);
      if (reported(row, *option, "zero").find("zero") == std::string::npos) continue;
      for (const char* value : {"nan", "inf", "-inf", "1e999"})
        EXPECT_NE(reported(row, *option, value), "") << name << " " << value;
      if (name.ends_with("--seed")) {
        EXPECT_NE(reported(row, *option, "-3"), "") << name;
      }
      numbers += reported(row, *option, "0.5").empty();
    }
  }
  EXPECT_GT(numbers, 30);
}

// The names of the commands with their options, "--json".
std::map<std::string, std::set<std::string>> options_by_command() {
  std::map<std::string, std::set<std::string>> all;
  for (const Command& row : all_commands()) {
    CLI::App app("", "mdof");
    row.declare(app);
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) all[row.name].insert("--" + name);
  }
  return all;
}

// For each option in the text: the command that is named last before it, within the same
// parentheses ("" if none), and the option.
std::vector<std::array<std::string, 2>> named_options(const std::string& text) {
  static const auto commands = options_by_command();
  static const std::regex word("mdof ([a-z0-9-]+ ?[a-z0-9-]*)|(--[a-z][a-z0-9-]*)|\\)");
  std::vector<std::array<std::string, 2>> found;
  std::string command;
  for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) {
    if ((*at)[2].matched) found.push_back({command, (*at)[2]});
    const std::string name = (*at)[1];
    if (at->str() == ")") command = "";
    if (commands.contains(name)) command = name;
    if (const auto first = name.substr(0, name.find(' ')); commands.contains(first))
      command = first;
  }
  return found;
}

constexpr words::Language kLanguages[] = {words::Language::english, words::Language::german};

// Several commands show the notices of a run. A notice that names an option must therefore name the
// command of this option, unless only the commands in this list give the notice.
TEST(Commands, OptionsInNoticesExist) {
  using Commands = std::vector<std::string>;
  const std::map<NoticeCode, Commands> given_by = {
      {NoticeCode::not_shown, {"show", "replay", "iso230-2", "budget", "squareness"}},
      {NoticeCode::map_units_assumed, {"form clamp", "form cut", "form compare", "form path"}},
      {NoticeCode::map_movement_gains_little, {"form compare"}},
      {NoticeCode::path_centre_assumed, {"form path"}},
      {NoticeCode::path_specks_ignored, {"form path"}},
      {NoticeCode::path_hides_undulations, {"form path"}},
      {NoticeCode::path_mostly_bridged, {"form path"}},
      {NoticeCode::path_stroke_bridged, {"form path"}},
      {NoticeCode::made_of_several_probes, {"separate reversal", "separate shift"}}};
  const auto options = options_by_command();
  const auto check = [&](NoticeCode code, words::Language language) {
    for (const auto& [command, option] : named_options(words::pattern(code, language))) {
      const auto by = given_by.find(code);
      const Commands commands =
          command.empty() && by != given_by.end() ? by->second : Commands{command};
      for (const std::string& each : commands)
        EXPECT_TRUE(options.contains(each) && options.at(each).contains(option))
            << to_string(code) << ": mdof " << each << " " << option;
    }
  };
  for (const auto language : kLanguages) {
#define NOTICE(code, severity, keys) check(NoticeCode::code, language);
#include "schema/notice/notice_codes.inc"
#undef NOTICE
  }
}

// mdofd gives these remedies for a run that `mdof record` or `mdof replay` measures.
constexpr Remedy kOfEachRun[] = {Remedy::raise_settle, Remedy::stop_longer, Remedy::move_faster};

TEST(Commands, OptionsInRemediesExist) {
  const auto options = options_by_command();
  const auto check = [&](Remedy remedy, words::Language language) {
    const bool needs_command =
        std::find(std::begin(kOfEachRun), std::end(kOfEachRun), remedy) != std::end(kOfEachRun);
    for (const auto& [command, option] : named_options(words::remedy(remedy, "", language))) {
      bool exists = false;
      for (const auto& [name, its] : options)
        exists |= (name == command || (command.empty() && !needs_command)) && its.contains(option);
      EXPECT_TRUE(exists) << to_string(remedy) << ": mdof " << command << " " << option;
    }
  };
  for (const auto language : kLanguages) {
#define REMEDY(code) check(Remedy::code, language);
#include "schema/base/remedy/remedies.inc"
#undef REMEDY
  }
}

TEST(Commands, EachCommandHasAnExampleAndASummary) {
  for (const Command& row : all_commands()) {
    EXPECT_NE(std::string(row.footer).find(std::string("mdof ") + row.name), std::string::npos)
        << row.name;
    EXPECT_NE(row.summary[0], '\0') << row.name;
    EXPECT_NE(std::string(row.summary).back(), '.') << row.name;
  }
}

TEST(Commands, TheCalledCommandIsChosen) {
  CLI::App app("", "mdof");
  Action chosen;
  declare_commands(app, chosen);
  app.parse("setup network not-an-address");
  ASSERT_TRUE(chosen);
  const Status done = chosen();
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("not-an-address"), std::string::npos);
}

TEST(Commands, AGroupRequiresASubcommand) {
  CLI::App app("", "mdof");
  Action chosen;
  declare_commands(app, chosen);
  EXPECT_THROW(app.parse("device"), CLI::RequiredError);
}

}  // namespace
}  // namespace mdof::tools
