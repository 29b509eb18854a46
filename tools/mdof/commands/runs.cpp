// mdof runs: what is stored.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct RunsCommand {
  std::string database, axis;
  std::int64_t count = 50, offset = 0;
  bool json = false;
};

std::string runs_json(const std::vector<RunHeader>& runs, std::int64_t total) {
  JsonWriter json;
  json.begin_object().field("total", total).key("runs").begin_array();
  for (const auto& header : runs) {
    json.begin_object();
    write_header_members(json, header);
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string runs_text(const std::vector<RunHeader>& runs, std::int64_t total) {
  TextTable table({"run", "axis", "state", "started", "model", "scans", "data", "log", "note"});
  for (const auto& h : runs) {
    const auto& from = h.provenance;
    table.add({std::to_string(h.id), std::string(1, letter(h.axis)), to_string(h.state),
               h.started_utc, from.model, std::to_string(h.scans),
               h.simulated ? "SIMULATED" : "measured",
               std::filesystem::path(from.recording_path).filename().string(), h.note});
  }
  std::string out = table.text(terminal_columns());
  const auto shown = static_cast<std::int64_t>(runs.size());
  if (shown < total)
    out += std::to_string(shown) + " of " + std::to_string(total) + " runs; --offset, --count\n";
  return out;
}

Status list_runs(const RunsCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  const auto axis = axis_from(command.axis);
  MDOF_TRY(const auto runs, store.list_runs(command.offset, command.count, axis));
  MDOF_TRY(const auto total, store.count_runs(axis));
  return command.json ? write_line(runs_json(runs, total)) : write_out(runs_text(runs, total));
}

}  // namespace

void add_runs(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<RunsCommand>();
  auto* command = app.add_subcommand("runs", "List the stored runs, newest first");
  add_database_option(*command, o->database);
  command->add_option("--axis", o->axis, "Only of this axis")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command->add_option("--offset", o->offset, "Leave out so many")->check(CLI::NonNegativeNumber);
  command->add_option("--count", o->count, "At most")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof runs --axis X --count 10");
  command->callback([o, &chosen] { chosen = [o] { return list_runs(*o); }; });
}

}  // namespace mdof::tools
