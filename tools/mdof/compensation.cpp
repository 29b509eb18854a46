// mdof compensation build|show|list|activate: what a controller corrects its commands with.
#include <CLI/CLI.hpp>
#include <optional>

#include "daemon/evaluation.h"
#include "daemon/paths.h"
#include "schema/run_json.h"
#include "tools/mdof/command.h"
#include "tools/mdof/compensation_text.h"
#include "tools/mdof/daemon_call.h"
#include "tools/mdof/database.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::int64_t kMostTables = 1'000'000;

struct CompensationCommand {
  std::string database, socket, axis, reference;  // empty: the rig's tool point, else the fixture
  std::vector<std::int64_t> runs;
  std::int64_t table = 0;
  bool keep_slope = false, partial = false, json = false;
};

Status print_table(const CompensationTable& table, std::int64_t generation, bool json) {
  return json ? write_line(table_document(table, generation))
              : write_out(table_text(table, generation));
}

// ---- build ----

Result<daemon::BuiltTable> build_and_store(const CompensationCommand& command) {
  MDOF_TRY(store::Store store, open_to_write(command.database));
  daemon::TableRequest request{command.runs, command.keep_slope, command.partial, {}};
  if (!command.reference.empty())
    reference_from(command.reference, request.reference.emplace());  // the option takes no other
  return daemon::build_table(store, request);
}

Status ask_daemon_to_build(const CompensationCommand& command) {
  JsonWriter params;
  params.begin_object().key("runs").begin_array();
  for (const std::int64_t id : command.runs) params.value(id);
  params.end_array();
  if (command.keep_slope) params.field("keep_slope", true);
  if (!command.reference.empty()) params.field("reference", command.reference);
  if (command.partial) params.field("partial", true);
  params.end_object();
  return print_call(command.socket, "compensation.build", params.text(), command.json);
}

Status build(const CompensationCommand& command) {
  MDOF_TRY(const bool busy, somebody_writes(command.database));
  if (busy) return ask_daemon_to_build(command);
  MDOF_TRY(const auto built, build_and_store(command));
  const auto& [table, warnings] = built;
  for (const auto& warning : warnings) warn(warning);
  MDOF_CHECK(command.json ? write_line(with_warnings(table_document(table, 0), warnings))
                          : write_out(table_text(table, 0)));
  say("stored; put it in force with: mdof compensation activate " + std::to_string(table.id));
  return {};
}

// ---- activate ----

Status activate(const CompensationCommand& command) {
  MDOF_TRY(const bool busy, somebody_writes(command.database));
  if (busy) {
    JsonWriter params;
    params.begin_object().field("table", command.table).end_object();
    return print_call(command.socket, "compensation.activate", params.text(), command.json);
  }
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(const auto generation, store.activate(command.table, "mdof", daemon::utc_now()));
  JsonWriter json;
  json.begin_object().field("table", command.table).field("generation", generation).end_object();
  return command.json ? write_line(json.text())
                      : write_line("table " + std::to_string(command.table) +
                                   " is in force, generation " + std::to_string(generation));
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
  add_json_flag(*command, o.json);
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
  of_build->add_option("RUN", o->runs, "Runs of one axis, the same targets")
      ->required()
      ->type_name("");
  of_build->add_flag("--keep-slope", o->keep_slope,
                     "Straightness as measured, not about its least-squares line");
  of_build->add_flag("--partial", o->partial, "Take partial runs as well");
  add_reference_option(*of_build, o->reference)
      ->description("fixture, carriage or tool [default: the rig's tool point, else the fixture]");
  add_socket_option(*of_build, o->socket);
  does(of_build, build);
  auto* of_show = declare(*group, "show", "Show a table [default: the one in force]", *o);
  of_show->add_option("TABLE", o->table, "Number of the table")->type_name("");
  add_axis_option(*of_show, o->axis);
  does(of_show, show);
  auto* of_list = declare(*group, "list", "List the stored tables, newest first", *o);
  add_axis_option(*of_list, o->axis);
  does(of_list, list);
  auto* of_activate = declare(*group, "activate", "Put a table in force on its axis", *o);
  of_activate->add_option("TABLE", o->table, "Number of the table")->required()->type_name("");
  add_socket_option(*of_activate, o->socket);
  does(of_activate, activate);
}

}  // namespace mdof::tools
