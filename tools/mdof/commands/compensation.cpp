// mdof compensation build|show|list|activate: what a controller corrects its commands with.
#include <CLI/CLI.hpp>
#include <optional>

#include "daemon/doer.h"
#include "daemon/measure/evaluation.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/holder.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/compensation_text.h"
#include "tools/mdof/text/table_csv.h"
#include "tools/mdof/text/warnings.h"

namespace mdof::tools {
namespace {

constexpr std::int64_t kMostTables = 1'000'000;

struct CompensationCommand {
  std::string database, socket, axis, reference;  // empty: the rig's tool point, else the fixture
  std::vector<std::string> words;                 // runs as they were given
  std::vector<std::int64_t> runs;
  std::int64_t table = 0;
  bool keep_slope = false, partial = false, csv = false, json = false, all_warnings = false;
  bool despite_warnings = false;
};

Status print_table(const CompensationTable& table, std::int64_t generation, bool json) {
  return json ? write_line(table_document(table, generation))
              : write_out(table_text(table, generation));
}

// ---- build ----

// What this program does itself.
Deed here(const char* name) {
  return daemon::deed_now(name, daemon::this_process());
}

Result<daemon::BuiltTable> build_and_store(const CompensationCommand& command) {
  MDOF_TRY(store::Store store, open_to_write(command.database));
  daemon::TableRequest request{
      command.runs, command.keep_slope, command.partial, {}, here("compensation.build")};
  if (!command.reference.empty())
    reference_from(command.reference, request.reference.emplace());  // the option takes no other
  return daemon::build_table(store, request);
}

// mdofd has the database: it builds and stores. What it stored is read and shown like a table of
// this program's.
Result<daemon::BuiltTable> build_there(rpc::Client& mdofd, const CompensationCommand& command) {
  JsonWriter params;
  params.begin_object().key("runs").begin_array();
  for (const std::int64_t id : command.runs) params.value(id);
  params.end_array();
  if (command.keep_slope) params.field("keep_slope", true);
  if (!command.reference.empty()) params.field("reference", command.reference);
  if (command.partial) params.field("partial", true);
  params.end_object();
  MDOF_TRY(const std::string reply, mdofd.call("compensation.build", params.text()));
  simdjson::dom::parser parser;
  const auto json = parser.parse(simdjson::padded_string(reply));
  daemon::BuiltTable built;
  built.warnings = texts(json, "warnings");
  built.notes = texts(json, "notes");
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(built.table, store.table(integer(json, "table").value_or(0)));
  return built;
}

Status choose_runs(CompensationCommand& command) {
  for (const auto& word : command.words) {
    MDOF_TRY(const auto run, run_number(command.database, word, axis_from(command.axis)));
    command.runs.push_back(run);
  }
  return {};
}

Status build(const CompensationCommand& asked) {
  CompensationCommand command = asked;
  MDOF_CHECK(choose_runs(command));
  MDOF_TRY(auto mdofd, mdofd_that_holds(command.database, command.socket));
  MDOF_TRY(const auto built, mdofd ? build_there(*mdofd, command) : build_and_store(command));
  const auto& [table, warnings, notes] = built;
  for (const auto& warning : summarised(warnings, command.all_warnings)) warn(warning);
  for (const auto& note : notes) say("note: " + note);
  MDOF_CHECK(command.json ? write_line(with_texts(with_warnings(table_document(table, 0), warnings),
                                                  "notes", notes))
                          : print_table(table, 0, false));
  say("stored; put it in force with: mdof compensation activate " + std::to_string(table.id) +
      (warnings.empty() && notes.empty() ? "" : " --despite-warnings"));
  return {};
}

// ---- activate and deactivate ----

// What came of it as text; the same JSON from mdofd and from here.
Status print_activation(const CompensationCommand& command, const std::string& reply,
                        const std::string& done, const std::string& already) {
  if (command.json) return write_line(reply);
  simdjson::dom::parser parser;
  const auto json = parser.parse(simdjson::padded_string(reply));
  return write_line((flag(json, "changed") ? done : already) + ", generation " +
                    std::to_string(integer(json, "generation").value_or(0)));
}

Result<std::string> activated(const CompensationCommand& command) {
  const std::string table = "\"table\":" + std::to_string(command.table);
  MDOF_TRY(auto mdofd, mdofd_that_holds(command.database, command.socket));
  const std::string despite = command.despite_warnings ? ",\"despite_warnings\":true" : "";
  if (mdofd) return mdofd->call("compensation.activate", "{" + table + despite + "}");
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(const auto done, daemon::activate_table(store, {command.table, command.despite_warnings,
                                                           here("compensation.activate")}));
  return store::activation_json(table, done);
}

Status activate(const CompensationCommand& command) {
  MDOF_TRY(const std::string reply, activated(command));
  const std::string table = "table " + std::to_string(command.table);
  return print_activation(command, reply, table + " is in force", table + " is already in force");
}

Result<std::string> deactivated(const CompensationCommand& command) {
  const std::string axis = "\"axis\":\"" + command.axis + "\"";
  MDOF_TRY(auto mdofd, mdofd_that_holds(command.database, command.socket));
  if (mdofd) return mdofd->call("compensation.deactivate", "{" + axis + "}");
  MDOF_TRY(store::Store store, open_to_write(command.database));
  const Deed deed = here("compensation.deactivate");
  MDOF_TRY(const auto done,
           store.deactivate(*axis_from(command.axis), daemon::doer_text(deed.by), deed.utc, deed));
  return store::activation_json(axis, done);
}

Status deactivate(const CompensationCommand& command) {
  MDOF_TRY(const std::string reply, deactivated(command));
  return print_activation(command, reply, "axis " + command.axis + " is no longer compensated",
                          "axis " + command.axis + ": no table was in force");
}

// ---- show and list ----

// Its generation where it is in force, else 0.
Result<std::int64_t> generation_of(store::Store& store, const CompensationTable& table) {
  const auto active = store.active(table.axis);
  if (active) return active->table.id == table.id ? active->generation : 0;
  if (active.error().code == ErrorCode::not_found) return 0;
  return tl::unexpected(active.error());
}

// The one asked for; else the one in force; else the newest.
Result<CompensationTable> choose_table(store::Store& store, const CompensationCommand& command) {
  if (command.table != 0) return store.table(command.table);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    if (!command.axis.empty() && axis_from(command.axis) != axis) continue;
    auto active = store.active(axis);
    if (active) return std::move(active->table);
    if (active.error().code != ErrorCode::not_found) return tl::unexpected(active.error());
  }
  MDOF_TRY(auto newest, store.list_tables(0, 1, axis_from(command.axis)));
  if (!newest.empty()) return std::move(newest.front());
  return fail(ErrorCode::not_found, store.file().string() + ": has no compensation table" +
                                        (command.axis.empty() ? "" : " of " + command.axis) +
                                        "; build one with mdof compensation build RUN");
}

Status show(const CompensationCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const CompensationTable table, choose_table(store, command));
  MDOF_TRY(const std::int64_t generation, generation_of(store, table));
  if (generation == 0)
    warn("table " + std::to_string(table.id) + " of axis " + letter(table.axis) +
         " is not in force");
  if (command.csv && table.simulated) warn("simulated data: no machine was measured");
  if (command.csv) return write_out(table_csv(table));
  return print_table(table, generation, command.json);
}

Status list(const CompensationCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto tables, store.list_tables(0, kMostTables, axis_from(command.axis)));
  std::vector<std::int64_t> generations;
  for (const auto& table : tables) {
    MDOF_TRY(const std::int64_t generation, generation_of(store, table));
    generations.push_back(generation);
  }
  return command.json ? write_line(list_document(tables, generations))
                      : write_out(list_text(tables, generations));
}

CLI::App* declare(CLI::App& group, const char* name, const char* what, CompensationCommand& o) {
  auto* command = group.add_subcommand(name, what);
  add_database_option(*command, o.database);
  return command;
}

void add_axis_option(CLI::App& command, std::string& axis) {
  command.add_option("--axis", axis, "Only of this axis")->check(CLI::IsMember({"X", "Y", "Z"}));
}

}  // namespace

void add_compensation(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<CompensationCommand>();
  auto* group = app.add_subcommand("compensation", "Build, show and activate compensation tables");
  group->require_subcommand(1);
  const auto does = [o, &chosen](CLI::App* command, Status (*what)(const CompensationCommand&)) {
    command->callback([o, &chosen, what] { chosen = [o, what] { return what(*o); }; });
  };
  auto* of_build = declare(*group, "build", "Mean errors of runs of one axis as a table", *o);
  add_run_arguments(*of_build, o->words, "Runs of one axis, the same targets; or latest");
  add_axis_of_latest(*of_build, o->axis);
  of_build->add_flag("--keep-slope", o->keep_slope,
                     "Straightness as measured, not about its least-squares line");
  of_build->add_flag("--partial", o->partial, "Take partial runs as well");
  add_reference_option(*of_build, o->reference)
      ->description("fixture, carriage or tool [default: the rig's tool point, else the fixture]");
  add_socket_option(*of_build, o->socket);
  add_json_flag(*of_build, o->json);
  add_all_warnings_flag(*of_build, o->all_warnings);
  of_build->footer(
      "Examples:\n  mdof compensation build 1 3 5\n  mdof compensation build latest --axis X");
  does(of_build, build);
  auto* of_show =
      declare(*group, "show", "Show a table [default: the one in force, else the newest]", *o);
  of_show->add_option("TABLE", o->table, "Number of the table")->type_name("");
  add_axis_option(*of_show, o->axis);
  add_csv_and_json_flags(*of_show, o->csv, o->json);
  of_show->footer("Example:\n  mdof compensation show --axis X --csv > table_X.csv");
  does(of_show, show);
  auto* of_list = declare(*group, "list", "List the stored tables, newest first", *o);
  add_axis_option(*of_list, o->axis);
  add_json_flag(*of_list, o->json);
  of_list->footer("Example:\n  mdof compensation list --axis X");
  does(of_list, list);
  auto* of_activate = declare(*group, "activate", "Put a table in force on its axis", *o);
  of_activate->add_option("TABLE", o->table, "Number of the table")->required()->type_name("");
  of_activate->add_flag("--despite-warnings", o->despite_warnings,
                        "Also a table whose runs carry warnings");
  add_socket_option(*of_activate, o->socket);
  add_json_flag(*of_activate, o->json);
  of_activate->footer("Example:\n  mdof compensation activate 1");
  does(of_activate, activate);
  auto* of_deactivate = declare(*group, "deactivate", "Take the table of an axis out of force", *o);
  of_deactivate->add_option("--axis", o->axis, "Of the machine")
      ->required()
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  add_socket_option(*of_deactivate, o->socket);
  add_json_flag(*of_deactivate, o->json);
  of_deactivate->footer("Example:\n  mdof compensation deactivate --axis X");
  does(of_deactivate, deactivate);
}

}  // namespace mdof::tools
