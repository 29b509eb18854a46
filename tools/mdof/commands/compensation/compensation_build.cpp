// mdof compensation build: builds and stores a table with the mean errors of runs of one axis, or
// the corrections over a plane or a volume of a machine.
#include <CLI/CLI.hpp>

#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/table_documents.h"
#include "daemon/words/words.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/volume_build.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/compensation_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

struct BuildCommand {
  // `reference`: name of the reference point of the errors; empty: the tool point of the rig, or
  // the fixture if the rig has no tool point.
  std::string database, socket, axis, reference;
  std::vector<std::string> words;  // the arguments RUN
  std::vector<std::int64_t> runs;
  std::optional<std::int64_t> add_to;
  bool keep_slope = false, partial = false, json = false, all_warnings = false;
  LimitOptions limits;
  VolumeOptions volume;
};

Result<daemon::BuiltTable> build_and_store(const BuildCommand& command) {
  MDOF_TRY(store::Store store, open_existing_to_write(command.database));
  daemon::TableRequest request{command.runs,
                               command.keep_slope,
                               command.partial,
                               {},
                               daemon::action_now("compensation.build", daemon::this_process())};
  request.add_to = command.add_to;
  MDOF_TRY(request.limits, command.limits.limits());
  if (!command.reference.empty())
    // The option accepts only valid names.
    reference_from(command.reference, request.reference.emplace());
  return daemon::build_table(store, request);
}

// If mdofd uses the database, mdofd builds and stores the table. This program then reads and shows
// the table.
Result<daemon::BuiltTable> build_in_daemon(rpc::Client& mdofd, const BuildCommand& command) {
  JsonWriter params;
  params.begin_object().key("runs").begin_array();
  for (const std::int64_t id : command.runs) params.value(id);
  params.end_array();
  if (command.keep_slope) params.field("keep_slope", true);
  if (!command.reference.empty()) params.field("reference", command.reference);
  if (command.partial) params.field("partial", true);
  if (command.add_to) params.field("add_to", *command.add_to);
  if (command.limits.um) params.field("limit_um", *command.limits.um);
  if (command.limits.um_per_mm) params.field("limit_um_per_mm", *command.limits.um_per_mm);
  params.end_object();
  MDOF_TRY(const std::string reply, mdofd.call("compensation.build", params.text()));
  simdjson::dom::parser parser;
  const auto json = parser.parse(simdjson::padded_string(reply));
  daemon::BuiltTable built;
  built.notices = notices_of(json);
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(built.table, store.table(integer(json, "table").value_or(0)));
  MDOF_TRY(built.doubtful, daemon::doubtful_notices(store, built.table));
  return built;
}

Status choose_runs(BuildCommand& command) {
  for (const auto& word : command.words) {
    MDOF_TRY(const auto run, run_number(command.database, word, axis_from(command.axis)));
    command.runs.push_back(run);
  }
  return {};
}

// Error: an option applies only to the other kind of table (axis or volume).
Status check_kind(const BuildCommand& command) {
  if (!command.volume.asked()) {
    if (command.words.empty())
      return fail(
          ErrorCode::usage,
          "missing run; give the numbers of runs, or --machine for a table of a plane or volume");
    return command.volume.check_unused();
  }
  if (!command.words.empty() || !command.axis.empty() || command.keep_slope || command.partial ||
      command.add_to || !command.reference.empty())
    return fail(ErrorCode::usage,
                "--machine takes the runs from the machine file; leave out RUN, --axis, --add-to, "
                "--keep-slope, --partial and --reference, which apply to tables of one axis");
  return {};
}

Status build(const BuildCommand& asked) {
  MDOF_CHECK(check_kind(asked));
  if (asked.volume.asked())
    return build_volume(
        {asked.volume, asked.limits, asked.database, asked.socket, asked.json, asked.all_warnings});
  BuildCommand command = asked;
  MDOF_CHECK(choose_runs(command));
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  MDOF_TRY(const auto built, mdofd ? build_in_daemon(*mdofd, command) : build_and_store(command));
  const auto& [table, notices, doubtful] = built;
  show_notices(notices, command.all_warnings);
  const std::string document = daemon::table_document(table, 0, !doubtful.empty());
  MDOF_CHECK(command.json ? write_line(with_notices(document, notices, words::text))
                          : write_out(table_text(table, 0)));
  const std::string named = std::to_string(table.id) + (table.simulated ? " --simulated" : "") +
                            (doubtful.empty() ? "" : " --despite-warnings");
  say(table.has_positioning()
          ? "stored; write the files for a controller with: mdof compensation export " + named +
                place_options(command.database)
          : "stored; activate the table with: mdof compensation activate " + named +
                place_options(command.database, command.socket));
  return {};
}

Action declare_build(CLI::App& command) {
  const auto o = std::make_shared<BuildCommand>();
  add_database_option(command, o->database);
  add_run_arguments(command, o->words,
                    "Numbers of runs of one axis with the same targets, or \"latest\"")
      ->required(false);
  add_latest_axis_option(command, o->axis);
  command.add_flag("--keep-slope", o->keep_slope,
                   "Keep the slope of straightness; do not subtract the least-squares line");
  command.add_flag("--partial", o->partial, "Also accept partial runs");
  command
      .add_option(
          "--add-to", o->add_to,
          "Number of the table that was active while the runs were measured. The new table is the "
          "sum of this table and of the errors that remained in the runs. The new table has the "
          "slope and the reference point of this table. mdof refuses a run that was measured "
          "without this table, and a run that lacks a target of this table")
      ->type_name("TABLE");
  add_reference_option(command, o->reference)
      ->description(
          "Point to which straightness refers: fixture, carriage or tool [default: tool point of "
          "the rig, else fixture]");
  add_limit_options(command, o->limits);
  add_volume_options(command, o->volume);
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return build(*o); };
}

}  // namespace

Command compensation_build_command() {
  return {.name = "compensation build",
          .summary = "Build a compensation table of an axis, a plane or a volume from mean errors",
          .footer =
              "Examples:\n"
              "  mdof compensation build 1 3 5\n"
              "  mdof compensation build latest --axis X\n"
              "  mdof compensation build 4 --add-to 1        # run 4: a check of table 1\n"
              "  mdof compensation build --machine machine.toml --volume --step-mm 10",
          .declare = declare_build};
}

}  // namespace mdof::tools
