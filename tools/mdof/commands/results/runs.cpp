// mdof runs: what is stored.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "daemon/words/words.h"
#include "schema/imported/series.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/list_page.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct RunsCommand {
  std::string database, axis;
  ListPage page;
  bool all = false, json = false;
};

std::string runs_json(const std::vector<RunHeader>& runs, std::int64_t total, std::int64_t offset) {
  JsonWriter json;
  json.begin_object().field("total", total).field("offset", offset).key("runs").begin_array();
  for (const auto& header : runs) {
    json.begin_object();
    write_header_members(json, header, words::text);
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

// The end of a run that another one supersedes is of no use; which one that is, in the end.
std::string state_of(store::Store& store, const RunHeader& run) {
  std::int64_t last = run.id;
  for (auto by = store.superseded_by(last); by && *by; by = store.superseded_by(last)) last = **by;
  return last != run.id ? "superseded by " + std::to_string(last) : to_string(run.state);
}

std::string runs_text(store::Store& store, const std::vector<RunHeader>& runs, std::int64_t total) {
  TextTable table({"run", "axis", "state", "started", "model", "scans", "data", "log", "note"});
  for (const auto& h : runs) {
    const auto& from = h.provenance;
    table.add({std::to_string(h.id), std::string(1, letter(h.axis)), state_of(store, h),
               h.started_utc, from.model, std::to_string(h.scans),
               h.simulated      ? "SIMULATED"
               : is_imported(h) ? "imported"
                                : "measured",
               std::filesystem::path(from.recording_path).filename().string(), h.note});
  }
  return table.text(terminal_columns()) + left_out(runs.size(), total, "runs");
}

Status list_runs(const RunsCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  const auto axis = axis_from(command.axis);
  const auto listed = command.all ? store::Store::Listed::all : store::Store::Listed::results;
  MDOF_TRY(const auto runs, store.list_runs(command.page.offset, command.page.count, axis, listed));
  MDOF_TRY(const auto total, store.count_runs(axis, listed));
  return command.json ? write_line(runs_json(runs, total, command.page.offset))
                      : write_out(runs_text(store, runs, total));
}

Action declare_runs(CLI::App& command) {
  const auto o = std::make_shared<RunsCommand>();
  add_database_option(command, o->database);
  add_only_axis_option(command, o->axis);
  command.add_flag("--all", o->all,
                   "Also list superseded runs (runs whose targets were renumbered in a new run)");
  add_page_options(command, o->page);
  add_json_flag(command, o->json);
  return [o] { return list_runs(*o); };
}

}  // namespace

Command runs_command() {
  return {.name = "runs",
          .summary = "List the stored runs, newest first",
          .footer = "Example:\n  mdof runs --axis X --count 10",
          .declare = declare_runs};
}

}  // namespace mdof::tools
