// mdof import FILE: stores errors that another instrument measured as a run.
#include <CLI/CLI.hpp>

#include "daemon/history.h"
#include "daemon/measure/imported/import.h"
#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/imported_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

struct ImportCommand {
  std::string database, socket, axis, sense, travel;
  daemon::ImportRequest request;
  LimitOptions limits;
  bool json = false;
};

std::string params_of(const ImportCommand& command) {
  const daemon::ImportRequest& request = command.request;
  JsonWriter json;
  json.begin_object().field("path", canonical_path(request.file)).field("axis", command.axis);
  if (!request.error.empty()) json.field("error", request.error);
  if (!request.format.empty()) json.field("format", request.format);
  if (!command.sense.empty()) json.field("sense", command.sense);
  if (!command.travel.empty()) json.field("travel", command.travel);
  if (request.u_um) json.field("u_um", *request.u_um);
  if (request.u_urad) json.field("u_urad", *request.u_urad);
  if (!request.note.empty()) json.field("note", request.note);
  if (command.limits.um) json.field("limit_um", *command.limits.um);
  if (command.limits.um_per_mm) json.field("limit_um_per_mm", *command.limits.um_per_mm);
  if (request.despite_warnings) json.field("despite_warnings", true);
  return json.end_object().take();
}

Result<Run> import_and_store(const ImportCommand& command) {
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  if (mdofd) return store_in_daemon(*mdofd, command.database, "run.import", params_of(command));
  MDOF_TRY(Run run, daemon::imported_run(command.request));
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(run.header.id,
           store.add_run(run, daemon::action_now("run.import", daemon::this_process())));
  return run;
}

Status import(ImportCommand command) {
  command.request.axis = *axis_from(command.axis);  // the option accepts only valid names
  command.request.sense = positioning_sense_from(command.sense);
  if (!command.travel.empty()) command.request.against_command = command.travel == "-";
  MDOF_TRY(command.request.limits, command.limits.limits());
  MDOF_TRY(Run run, import_and_store(command));
  show_notices(run.header.notices, true);
  const bool positioning = run.header.provenance.model == positioning_name(run.header.axis);
  if (positioning && command.sense.empty())
    say(run.header.provenance.model +
        " is read as actual minus commanded position in the coordinates of the controller (the "
        "default of the format). If the errors in the file are positive in the + direction of "
        "the machine axis, set --sense body");
  // Only positioning errors can become a table. For other errors the reference point is unknown.
  say(std::string("stored; ") +
      (positioning ? "build a compensation table with: mdof compensation build "
                   : "show the run with: mdof show ") +
      std::to_string(run.header.id) + place_options(command.database));
  if (command.json) return write_line(daemon::import_document(run.header, run.points.size()));
  run.header.notices.clear();  // they were shown already
  return write_out(imported_text(run, {}, "", terminal_columns(), false));
}

Action declare_import(CLI::App& command) {
  const auto o = std::make_shared<ImportCommand>();
  command
      .add_option("FILE", o->request.file,
                  "File to import: CSV, ISO 230-2 series as CSV, or Renishaw .rtl")
      ->required()
      ->type_name("");
  command.add_option("--axis", o->axis, "Axis of the machine")
      ->required()
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command
      .add_option("--error", o->request.error,
                  "Measured error, such as EYX [default: positioning, such as EXX for X]")
      ->type_name("NAME");
  command
      .add_option("--format", o->request.format,
                  "Format of the file [default: recognised from the file]")
      ->check(CLI::IsMember({"csv", "iso230-2", "rtl"}));
  command
      .add_option(
          "--sense", o->sense,
          "Sign of positioning errors: \"command\" (actual minus commanded position, ISO "
          "230-2) or \"body\" (positive in the + direction of the machine axis) [default: command]")
      ->check(CLI::IsMember({"command", "body"}));
  command
      .add_option(
          "--travel", o->travel,
          "Direction in which the moving body moves when the commanded position increases: + "
          "or - along the machine axis [default: unknown]")
      ->check(CLI::IsMember({"+", "-"}));
  command
      .add_option("--u-um", o->request.u_um,
                  "Standard uncertainty of each deviation (from laser, alignment and temperature)")
      ->check(not_negative_number());
  command
      .add_option("--u-urad", o->request.u_urad,
                  "Standard uncertainty of each deviation of an angular error")
      ->check(not_negative_number());
  command.add_option("--note", o->request.note, "Note stored with the run; at most 1024 bytes")
      ->type_name("TEXT")
      ->check([](const std::string& note) {
        return std::string(note.size() <= 1024 ? "" : "a note has at most 1024 bytes");
      });
  add_limit_options(command, o->limits);
  command.add_flag("--despite-warnings", o->request.despite_warnings,
                   "Import the file even if mdof prints warnings about the file");
  add_database_option(command, o->database);
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return import(*o); };
}

}  // namespace

Command import_command() {
  return {.name = "import",
          .summary = "Import errors from another instrument and store them as a run",
          .footer =
              "Columns of CSV: position_mm, deviation_um (or deviation_urad) and, if known, "
              "direction (1 or -1) and run. Columns of an ISO 230-2 series: target_mm, direction, "
              "run, deviation_um.\n"
              "Examples:\n"
              "  mdof import laser_X.rtl --axis X --u-um 0.3\n"
              "  mdof import errors_Y.csv --axis Y --sense body --travel -\n"
              "  mdof import straightness.csv --axis X --error EYX",
          .declare = declare_import};
}

}  // namespace mdof::tools
