// mdof compensation export: writes tables as files for the controller of a machine.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "schema/base/output/output_files.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/exported.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

struct ExportTablesCommand {
  ExportRequest request;
  std::string folder;
  bool list = false, overwrite = false, json = false;
};

std::string formats_json() {
  JsonWriter json;
  json.begin_object().key("formats").begin_array();
  for (const controllers::Format& f : controllers::formats())
    json.begin_object()
        .field("format", f.name)
        .field("of", f.of)
        .field("holds", f.holds)
        .field("limits", f.limits)
        .field("sense", f.sense)
        .field("source", f.source)
        .field("sign_confirmed", f.sign_confirmed)
        .end_object();
  json.end_array().key("not_written").begin_array();
  for (const controllers::UnsupportedController& one : controllers::not_written())
    json.begin_object()
        .field("format", one.name)
        .field("of", one.of)
        .field("reason", one.reason)
        .field("instead", one.instead)
        .end_object();
  json.end_array().end_object();
  return json.take();
}

std::string formats_text(std::size_t width) {
  std::string text;
  for (const controllers::Format& f : controllers::formats()) {
    text += std::string(f.name) + ": " + f.of + "\n";
    for (const auto& [label, what] : {std::pair{"contents  ", f.holds},
                                      {"limits    ", f.limits},
                                      {"sign      ", f.sense},
                                      {"source    ", f.source}})
      text += "  " + wrapped(std::string(label) + what, width - 2, 12) + "\n";
    if (!f.sign_confirmed) text += "  SIGN NOT CONFIRMED: an export needs --unverified-sign\n";
  }
  for (const controllers::UnsupportedController& one : controllers::not_written()) {
    text += std::string(one.name) + ": " + one.of + "\n  NOT WRITTEN\n";
    text += "  " + wrapped(std::string("reason    ") + one.reason, width - 2, 12) + "\n";
    text += "  " + wrapped(std::string("instead   ") + one.instead, width - 2, 12) + "\n";
  }
  return text;
}

// Whether the error is an angle: true for "EAX", false for "EXX".
bool is_angle(const std::string& error) {
  return error.size() > 1 && std::string_view("ABC").find(error[1]) != std::string_view::npos;
}

// Error: one of the files exists already. Files of two exports in one folder could together be a
// wrong table.
Status check_free(const std::vector<fs::path>& files) {
  std::error_code ec;
  for (const fs::path& file : files)
    if (fs::exists(fs::symlink_status(file, ec)))
      return fail(ErrorCode::usage, file.string() +
                                        ": the file exists already; give another folder with "
                                        "--out, or replace the file with --overwrite");
  return {};
}

Result<std::vector<std::string>> write_files(const ExportTablesCommand& command,
                                             const controllers::Export& files) {
  std::vector<fs::path> paths;
  for (const auto& file : files.files) paths.push_back(fs::path(command.folder) / file.name);
  if (!command.overwrite) MDOF_CHECK(check_free(paths));
  std::error_code ec;
  fs::create_directories(command.folder, ec);
  if (ec) return io_error(command.folder + ": cannot be created: " + ec.message());
  OutputFiles out(command.overwrite ? Existing::replace : Existing::refuse);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    MDOF_TRY(const std::size_t file, out.add(paths[i]));
    MDOF_CHECK(out.write(file, files.files[i].text));
    names.push_back(paths[i].string());
  }
  MDOF_CHECK(out.publish());
  return names;
}

std::string exported_json(const ExportedTables& exported, const std::vector<std::string>& names) {
  JsonWriter json;
  json.begin_object().field("format", exported.format->name).field("sense", exported.format->sense);
  json.field("source", exported.format->source);
  json.field("sign_confirmed", exported.format->sign_confirmed);
  json.field("simulated", exported.simulated).field("doubtful", exported.doubtful);
  json.key("tables").begin_array();
  for (const std::int64_t table : exported.tables) json.value(table);
  json.end_array().key("squareness");
  exported.squareness > 0 ? json.value(exported.squareness) : json.null();
  write_strings(json, "files", names);
  json.key("written").begin_array();
  if (exported.squareness > 0)
    json.begin_object()
        .field("error", "EC0Y")
        .field("value_urad", to_urad(exported.angle.value))
        .field("u_urad", to_urad(exported.angle.u))
        .field("U_urad", to_urad(exported.angle.U))
        .field("k", exported.angle.coverage_factor)
        .end_object();
  for (const auto& written : exported.files.written)
    json.begin_object()
        .field("error", written.error)
        .field("points", static_cast<std::uint64_t>(written.points))
        .field("points_before", static_cast<std::uint64_t>(written.points_before))
        .field(is_angle(written.error) ? "largest_deviation_urad" : "largest_deviation_um",
               written.largest_deviation * 1e6)
        .end_object();
  json.end_array();
  write_strings(json, "left_out", exported.files.left_out);
  write_strings(json, "notes", exported.files.notes);
  write_strings(json, "marks", exported.options.marks);
  json.key("check").raw(check_json(exported)).end_object();
  return json.take();
}

std::string exported_text(const ExportedTables& exported, const std::vector<std::string>& names) {
  std::string text;
  text += std::string("sign convention: ") + exported.format->sense + "\n";
  if (exported.squareness > 0)
    text += "EC0Y: " + urad_to_place(exported.angle.value, exported.angle.U) + " µrad (U " +
            urad_to_place(exported.angle.U, exported.angle.U) +
            " µrad, 95 %), one angle for all positions\n";
  for (const auto& written : exported.files.written)
    text += written.error + ": " + std::to_string(written.points) +
            (written.points > written.points_before ? " points from " : " of ") +
            std::to_string(written.points_before) +
            (written.points <= written.points_before ? " points kept"
             : written.points_before == 1            ? " target"
                                                     : " targets") +
            ", largest deviation from the full table " + fixed(written.largest_deviation * 1e6, 4) +
            (is_angle(written.error) ? " µrad\n" : " µm\n");
  text += "check: mdof read the files back and applied them to a simulated axis\n";
  std::string files;
  for (const auto& name : names) files += name + "\n";
  if (exported.squareness > 0) files += exported.files.files.front().text;  // for copying
  return files + fitted(text, terminal_columns()) + check_text(exported.check);
}

Status export_tables(const ExportTablesCommand& command) {
  if (command.list)
    return command.json ? write_line(formats_json()) : write_out(formats_text(terminal_columns()));
  // Checks the format before --out, because a format that mdof cannot write is an error with any
  // --out.
  MDOF_CHECK(format_of(command.request));
  if (command.folder.empty()) return fail(ErrorCode::usage, "missing option --out FOLDER");
  MDOF_TRY(const ExportedTables exported, exported_tables(command.request));
  for (const auto& mark : exported.options.marks) warn(mark);
  for (const auto& note : exported.files.notes) say("note: " + note);
  for (const auto& left : exported.files.left_out) say("left out: " + left);
  if (!exported.check.passed())
    return fail(ErrorCode::check, std::string(exported.check.nothing_to_correct()
                                                  ? "the files would correct nothing:\n"
                                                  : "the files would not cancel the error:\n") +
                                      check_text(exported.check) + "no file was written");
  MDOF_TRY(const auto names, write_files(command, exported.files));
  return command.json ? write_line(exported_json(exported, names))
                      : write_out(exported_text(exported, names));
}

Action declare_export_tables(CLI::App& command) {
  const auto o = std::make_shared<ExportTablesCommand>();
  add_export_options(command, o->request, "; the files then contain a remark");
  command.add_option("--out", o->folder, "Folder for the files (created if missing)")
      ->type_name("FOLDER");
  command.add_flag("--overwrite", o->overwrite, "Replace existing files");
  command.add_flag(
      "--list", o->list,
      "List the formats: contents, limits, sign convention, and source of the sign convention");
  add_json_flag(command, o->json);
  return [o] { return export_tables(*o); };
}

}  // namespace

Command compensation_export_command() {
  return {.name = "compensation export",
          .summary = "Write tables as the files of a controller",
          .footer =
              "Examples:\n"
              "  mdof compensation export --list\n"
              "  mdof compensation export 4 5 6 --format linuxcnc --tolerance-um 0.1 --out comp\n"
              "  mdof compensation export 7 --format dynomotion --out geo\n"
              "  mdof compensation export --squareness latest --format klipper --out skew",
          .declare = declare_export_tables};
}

}  // namespace mdof::tools
