// mdof compensation show: shows a table, by default the active table.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "daemon/measure/gate/gate.h"
#include "daemon/measure/gate/table_documents.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/words/error_text.h"
#include "schema/axis.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/csv/table_csv.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/compensation_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/volumetric_text.h"

namespace mdof::tools {
namespace {

struct ShowTableCommand {
  std::string database, axis;
  std::int64_t table = 0;  // 0: choose_table() decides
  bool csv = false, json = false;
};

// The number of the table to show: the requested table, otherwise the active table, otherwise the
// newest table. If the user stated an axis, only tables of this axis count.
Result<std::int64_t> choose_table(store::Store& store, const ShowTableCommand& command) {
  if (command.table != 0) return command.table;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    if (!command.axis.empty() && axis_from(command.axis) != axis) continue;
    const auto active = store.active(axis);
    if (active) return active->table.id;
    if (active.error().code != ErrorCode::not_found) return tl::unexpected(active.error());
  }
  std::int64_t newest = 0;
  if (command.axis.empty()) {
    const auto active = store.active_volumetric();
    if (active) return active->table.id;
    if (active.error().code != ErrorCode::not_found) return tl::unexpected(active.error());
    MDOF_TRY(const auto volumes, store.list_volumetric(0, 1));
    if (!volumes.empty()) newest = volumes.front().id;
  }
  MDOF_TRY(const auto tables, store.list_tables(0, 1, axis_from(command.axis)));
  if (!tables.empty()) newest = std::max(newest, tables.front().id);
  if (newest > 0) return newest;
  return fail(ErrorCode::not_found, store.file().string() +
                                        ": the database has no compensation table" +
                                        (command.axis.empty() ? "" : " of axis " + command.axis) +
                                        "; build a table with: mdof compensation build RUN" +
                                        place_options(command.database));
}

Status show_volume(store::Store& store, const ShowTableCommand& command, std::int64_t id) {
  MDOF_TRY(const VolumetricTable table, store.volumetric(id));
  MDOF_TRY(const std::int64_t generation, generation_of(store, table));
  if (generation == 0) warn("table " + std::to_string(table.id) + " of the volume is not active");
  MDOF_TRY(const daemon::Judged judged, daemon::judged_table(store, table));
  show_notices(judged.doubtful, true);
  if (command.csv && table.simulated) warn("simulated data: no machine was measured");
  if (command.csv)
    return write_out(noise_only_comment(table.noise_only) +
                     csv_marks(daemon::warning_marks(judged)) + volumetric_csv(table));
  return command.json
             ? write_line(daemon::volumetric_document(table, generation, !judged.doubtful.empty()))
             : write_out(volumetric_text(table, generation));
}

Status show(const ShowTableCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const std::int64_t id, choose_table(store, command));
  MDOF_TRY(const bool volume, store.is_volumetric(id));
  if (volume) return show_volume(store, command, id);
  MDOF_TRY(const CompensationTable table, store.table(id));
  MDOF_TRY(const std::int64_t generation, generation_of(store, table));
  if (generation == 0)
    warn("table " + std::to_string(table.id) + " of axis " + letter(table.axis) + " is not active");
  const auto read = daemon::doubtful_notices(store, table);
  if (!read) warn(words::text(read.error()));
  const Notices doubtful = read.value_or(Notices{notice(NoticeCode::run_unreadable)});
  show_notices(doubtful, true);
  if (command.csv && table.simulated) warn("simulated data: no machine was measured");
  const auto marks = daemon::warning_marks(
      {daemon::JudgedKind::table, std::to_string(table.id), table.simulated, doubtful});
  if (command.csv)
    return write_out(noise_only_comment(table.noise_only()) + csv_marks(marks) + table_csv(table));
  return command.json ? write_line(daemon::table_document(table, generation, !doubtful.empty()))
                      : write_out(table_text(table, generation));
}

Action declare_show(CLI::App& command) {
  const auto o = std::make_shared<ShowTableCommand>();
  add_database_option(command, o->database);
  command.add_option("TABLE", o->table, "Number of the table")->type_name("");
  add_only_axis_option(command, o->axis);
  add_csv_and_json_flags(command, o->csv, o->json);
  return [o] { return show(*o); };
}

}  // namespace

Command compensation_show_command() {
  return {.name = "compensation show",
          .summary = "Show a table [default: the active table, else the newest table]",
          .footer = "Example:\n  mdof compensation show --axis X --csv > table_X.csv",
          .declare = declare_show};
}

}  // namespace mdof::tools
