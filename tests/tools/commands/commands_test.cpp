#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

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
