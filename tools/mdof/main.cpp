// mdof: the command line.
#include <csignal>
#include <exception>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "daemon/words/help_formatter.h"
#include "schema/base/instruction_set.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/exit_code.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/usage.h"

namespace {

using namespace mdof;
using namespace mdof::tools;

constexpr const char* kExamples =
    "Examples:\n"
    "  mdof selftest\n"
    "  mdof replay log_X.csv.gz --rig rig_X.toml   evaluate a log and store the run\n"
    "  mdof show 1                                 show the points of run 1\n"
    "  mdof squareness 1 2                         squareness from runs 1 (X) and 2 (Y)\n"
    "  mdof compensation build 1                   build a table for the controller\n"
    "  mdof sensitivity --preset simulation-2      effect of mounting errors\n"
    "  mdof record --axis X --from-mm 0 --to-mm 60 --interval-mm 5 --repeats 5\n"
    "  mdof device probe --config mdofd.toml       check the devices and their wiring\n"
    "  mdof live                                   show the readings of the probes\n"
    "Exit codes: 0 ok, 1 a check failed, 2 wrong usage, 3 bad input, 4 device or I/O error.";

void declare(CLI::App& app, Action& chosen) {
  app.formatter(std::make_shared<words::HelpFormatter>(terminal_columns()));
  app.set_version_flag("--version", daemon::kVersion, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  declare_commands(app, chosen);
  app.require_subcommand(
      0, 1);              // one command only: the second word of "mdof help replay" is no command
  app.footer(kExamples);  // set after the commands, because they have their own examples
}

int run(int argc, char** argv) {
  CLI::App app{
      "Calculate straightness, angles and squareness of machine axes from the readings of five "
      "probes.",
      "mdof"};
  Action chosen;
  declare(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    say("mdof: " + usage_message(app, error));
    return kUsage;
  }
  if (!chosen) {
    say("mdof: missing command; see mdof --help");
    return kUsage;
  }
  Status done = check_instruction_set();
  if (done) done = chosen();
  if (done) return kOk;
  say("mdof: " + words::text(done.error()));
  return exit_code_for(done.error().code);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // write_out() gets the error EPIPE
  try {
    return run(argc, argv);
  } catch (const std::filesystem::filesystem_error& error) {
    say("mdof: " + error.path1().string() + ": " + error.code().message() +
        "; check that the folder exists and that you have permission to use it");
    return kDeviceOrIo;
  } catch (const std::exception& error) {  // out of memory, or a bug
    say(std::string("mdof: ") + error.what());
    return kDeviceOrIo;
  }
}
