// mdof selftest: checks that this installation calculates errors, detects points and stores runs
// correctly. It needs no files.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "tools/mdof/checks/self_checks.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

std::string figure_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

std::string checks_json(const std::vector<SelfCheck>& checks) {
  JsonWriter json;
  json.begin_object().key("checks").begin_array();
  for (const auto& c : checks) {
    json.begin_object()
        .field("what", c.what)
        .field("figure", c.figure)
        .field("bound", c.bound)
        .field("unit", c.unit)
        .field("passed", c.passed())
        .field("problem", c.problem)
        .end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string checks_text(const std::vector<SelfCheck>& checks) {
  TextTable table({"check", "value", "limit", "unit", "result"});
  for (const auto& c : checks) {
    table.add({c.what, figure_text(c.figure), figure_text(c.bound), c.unit,
               c.passed() ? "ok" : "FAILED " + c.problem});
  }
  return table.text(terminal_columns());
}

Status selftest(bool json) {
  const auto checks = run_self_checks();
  MDOF_CHECK(json ? write_line(checks_json(checks)) : write_out(checks_text(checks)));
  const auto failed =
      std::count_if(checks.begin(), checks.end(), [](const SelfCheck& c) { return !c.passed(); });
  if (failed == 0) return {};
  return fail(ErrorCode::check, std::to_string(failed) + " of " + std::to_string(checks.size()) +
                                    " checks failed; do not measure with this installation");
}

Action declare_selftest(CLI::App& command) {
  const auto json = std::make_shared<bool>(false);
  add_json_flag(command, *json);
  return [json] { return selftest(*json); };
}

}  // namespace

Command selftest_command() {
  return {.name = "selftest",
          .summary = "Check this installation; needs no files",
          .footer = "Example:\n  mdof selftest",
          .declare = declare_selftest};
}

}  // namespace mdof::tools
