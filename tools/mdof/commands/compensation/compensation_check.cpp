// mdof compensation check: checks whether the exported files would correct the errors in the
// tables.
#include <CLI/CLI.hpp>

#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/exported.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

struct CheckTablesCommand {
  ExportRequest request;
  bool json = false;
};

Status check_tables(const CheckTablesCommand& command) {
  MDOF_TRY(const ExportedTables exported, exported_tables(command.request));
  for (const auto& mark : exported.options.marks) warn(mark);
  for (const auto& note : exported.files.notes) say("note: " + note);
  for (const auto& left : exported.files.left_out) say("left out: " + left);
  MDOF_CHECK(command.json ? write_line(check_json(exported))
                          : write_out(check_text(exported.check)));
  if (exported.check.errors.empty())
    return fail(ErrorCode::check,
                "nothing could be checked: the correction sign is unknown for every error");
  if (exported.check.passed()) return {};
  if (exported.check.nothing_to_correct())
    return fail(ErrorCode::check,
                "nothing to correct, because all errors are smaller than the last digit of the "
                "format; check the unit "
                "of the measured values");
  return fail(ErrorCode::check,
              "the exported files do not cancel the errors, or the check does not detect a "
              "deliberate mistake (wrong sign, exchanged approaches)");
}

Action declare_check_tables(CLI::App& command) {
  const auto o = std::make_shared<CheckTablesCommand>();
  add_export_options(command, o->request, "");
  add_json_flag(command, o->json);
  return [o] { return check_tables(*o); };
}

}  // namespace

Command compensation_check_command() {
  return {.name = "compensation check",
          .summary = "Apply an export to a simulated axis and check that the error is cancelled",
          .footer =
              "mdof writes the files in memory, reads the files by the rules of the controller, "
              "and applies the read values to a simulated axis with the errors of the table. The "
              "check must also detect a wrong sign and exchanged approaches.\nExample:\n "
              " mdof compensation check 4 --format linuxcnc",
          .declare = declare_check_tables};
}

}  // namespace mdof::tools
