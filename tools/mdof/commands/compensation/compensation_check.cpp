// mdof compensation check: would the exported tables make the error vanish?
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
  for (const auto& left : exported.files.left_out) say("left out: " + left);
  MDOF_CHECK(command.json ? write_line(check_json(exported.check))
                          : write_out(check_text(exported.check)));
  if (exported.check.errors.empty())
    return fail(ErrorCode::check,
                "nothing could be judged: of no error it is known which way its "
                "correction goes");
  if (exported.check.passed()) return {};
  return fail(ErrorCode::check, "the error does not vanish, or a mistake would not be seen");
}

Action declare_check_tables(CLI::App& command) {
  const auto o = std::make_shared<CheckTablesCommand>();
  add_export_options(command, o->request);
  add_json_flag(command, o->json);
  return [o] { return check_tables(*o); };
}

}  // namespace

Command compensation_check_command() {
  return {
      .name = "compensation check",
      .summary = "Apply an export to a simulated axis: does the error vanish",
      .footer =
          "The files are written in memory, read back by the controller's own rules and applied "
          "to an axis that has the table's errors; a wrong sign and swapped approaches must be "
          "seen.\nExample:\n  mdof compensation check 4 --format linuxcnc",
      .declare = declare_check_tables};
}

}  // namespace mdof::tools
