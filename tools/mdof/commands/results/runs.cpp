// mdof runs: lists the stored runs with run.list.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>

#include "daemon/run_item.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/list_page.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::element;

constexpr std::int64_t kListPage = 100;  // largest number of runs in one reply of run.list

struct RunsCommand {
  std::string database, socket, axis;
  ListPage page;
  bool all = false, json = false;
};

Result<std::string> list_from_database(const RunsCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  return daemon::run_list_document(
      store, {command.page.offset, command.page.count, axis_from(command.axis), command.all},
      std::numeric_limits<std::size_t>::max(), {});
}

struct RunsPage {
  std::int64_t total = 0;
  std::vector<std::string> runs;  // in the order of the reply
};

Result<RunsPage> page_in(const std::string& reply) {
  using namespace simdjson;
  const padded_string text(reply);
  ondemand::parser parser;
  ondemand::document document;
  ondemand::array runs;
  RunsPage page;
  if (parser.iterate(text).get(document) || document["total"].get_int64().get(page.total) ||
      document["runs"].get_array().get(runs))
    return io_error("mdofd sent a list of runs that cannot be read");
  for (auto run : runs) {
    ondemand::value item;
    std::string_view json;
    if (run.get(item) || to_json_string(item).get(json))
      return io_error("mdofd sent a run that cannot be read");
    page.runs.emplace_back(json);
  }
  return page;
}

Result<RunsPage> ask_for_page(rpc::Client& mdofd, const RunsCommand& command, std::int64_t skipped,
                              std::int64_t left) {
  JsonWriter params;
  params.begin_object().field("offset", command.page.offset + skipped);
  params.field("count", std::clamp<std::int64_t>(left, 1, kListPage)).field("all", command.all);
  if (!command.axis.empty()) params.field("axis", command.axis);
  MDOF_TRY(const std::string reply, mdofd.call("run.list", params.end_object().take()));
  return page_in(reply);
}

Result<std::string> list_from_daemon(rpc::Client& mdofd, const RunsCommand& command) {
  const auto wanted = static_cast<std::size_t>(command.page.count);
  RunsPage whole;
  for (bool more = true; more;) {
    const auto have = static_cast<std::int64_t>(whole.runs.size());
    MDOF_TRY(const RunsPage page, ask_for_page(mdofd, command, have, command.page.count - have));
    whole.total = page.total;
    for (const std::string& run : page.runs)
      if (whole.runs.size() < wanted) whole.runs.push_back(run);
    more = !page.runs.empty() && whole.runs.size() < wanted &&
           command.page.offset + static_cast<std::int64_t>(whole.runs.size()) < whole.total;
  }
  JsonWriter json;
  json.begin_object().field("total", whole.total).field("offset", command.page.offset);
  json.key("runs").begin_array();
  for (const std::string& run : whole.runs) json.raw(run);
  return json.end_array().end_object().take();
}

std::string state_of(const element& run) {
  const auto by = integer(run, "superseded_by");
  return by ? "superseded by " + std::to_string(*by) : text(run, "state");
}

std::string runs_text(const element& document) {
  TextTable table({"run", "axis", "state", "started", "model", "scans", "data", "log", "note"});
  std::size_t shown = 0;
  for (const element run : document["runs"].get_array()) {
    const bool imported = text(run["recording"], "kind").starts_with("imported");
    table.add({std::to_string(integer(run, "run").value_or(0)), text(run, "axis"), state_of(run),
               text(run, "started_utc"), text(run, "model"),
               std::to_string(integer(run, "scans").value_or(0)),
               flag(run, "simulated") ? "SIMULATED"
               : imported             ? "imported"
                                      : "measured",
               std::filesystem::path(text(run["recording"], "path")).filename().string(),
               text(run, "note")});
    ++shown;
  }
  return table.text(terminal_columns()) +
         left_out(shown, integer(document, "total").value_or(0), "runs");
}

Status list_runs(const RunsCommand& command) {
  MDOF_TRY(auto mdofd, serving_daemon(command.database, command.socket));
  MDOF_TRY(const std::string document,
           mdofd ? list_from_daemon(*mdofd, command) : list_from_database(command));
  if (command.json) return write_line(document);
  simdjson::dom::parser parser;
  return write_out(runs_text(parser.parse(simdjson::padded_string(document))));
}

Action declare_runs(CLI::App& command) {
  const auto o = std::make_shared<RunsCommand>();
  add_database_option(command, o->database);
  add_socket_option(command, o->socket);
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
