// mdof stop: ends the runs in progress; mdofd evaluates and stores them.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "daemon/paths.h"
#include "daemon/rpc/line/client.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

using simdjson::dom::element;

struct StopCommand {
  std::string socket, axis;
  bool abort = false, json = false;
};

struct RunInProgress {
  std::string axis;
  std::int64_t run = 0;
};

// The reply of run.stop for one run.
struct Stopped {
  std::string reply, axis, state;
  std::int64_t run = 0;  // number of the stored run; it can be a run that superseded the ended run
  Notices notices;
};

// The runs in progress, of `axis` if it is not empty. Error: mdofd does not have this axis.
Result<std::vector<RunInProgress>> runs_in_progress(const std::string& info,
                                                    const std::string& axis) {
  simdjson::dom::parser parser;
  std::vector<RunInProgress> runs;
  bool known = axis.empty();
  for (const element of : parser.parse(simdjson::padded_string(info)).at_key("axes").get_array()) {
    const std::string name = text(of, "axis");
    if (!axis.empty() && name != axis) continue;
    known = true;
    if (const auto run = integer(of, "run")) runs.push_back({name, *run});
  }
  if (known) return runs;
  return fail(ErrorCode::not_found, "mdofd does not measure axis " + axis +
                                        "; to list the configured axes, use: mdof status");
}

// `info` is the reply of server.info.
Result<std::vector<Stopped>> stop_all(rpc::Client& client, const std::string& info,
                                      const StopCommand& command) {
  MDOF_TRY(const auto runs, runs_in_progress(info, command.axis));
  if (runs.empty())
    return fail(ErrorCode::not_found,
                "no run" + (command.axis.empty() ? "" : " of axis " + command.axis) +
                    " is in progress; to list the runs that have ended, use: mdof runs");
  std::vector<Stopped> all;
  for (const RunInProgress& run : runs) {
    JsonWriter params;
    params.begin_object().field("run", run.run).field("abort", command.abort).end_object();
    MDOF_TRY(const std::string reply, client.call("run.stop", params.text()));
    simdjson::dom::parser parser;
    const auto stopped = parser.parse(simdjson::padded_string(reply));
    all.push_back({reply, run.axis, text(stopped, "state"),
                   integer(stopped, "run").value_or(run.run), notices_of(stopped)});
  }
  return all;
}

std::string stopped_json(const std::vector<Stopped>& runs) {
  JsonWriter json;
  json.begin_object().key("stopped").begin_array();
  for (const auto& run : runs) json.raw(run.reply);
  json.end_array().end_object();
  return json.take();
}

bool has_failed(const Stopped& run) {
  return run.state == "failed";
}

std::string name_of(const Stopped& run) {
  return "run " + std::to_string(run.run) + " of axis " + run.axis;
}

// A text about a failed run, with the reasons from its notices.
std::string failure_text(const Stopped& run) {
  std::string reasons;
  for (const Notice& each : run.notices)
    if (each.code == NoticeCode::failure)
      reasons += (reasons.empty() ? ": " : "; ") + words::text(each);
  return name_of(run) + " failed" + reasons;
}

// Error (check): a run has failed. The message names all failed runs and the reasons.
Status check_results(const std::vector<Stopped>& runs) {
  std::string failures;
  for (const Stopped& run : runs)
    if (has_failed(run)) failures += (failures.empty() ? "" : "; ") + failure_text(run);
  return failures.empty() ? Status() : fail(ErrorCode::check, failures);
}

// The option --db with the database of mdofd, for a command that shows the run. Empty if this
// command uses the same database by default.
std::string database_option(const std::string& info) {
  simdjson::dom::parser parser;
  const std::string database = text(parser.parse(simdjson::padded_string(info)), "database");
  std::error_code ec;
  const auto by_default = daemon::default_database();
  const bool is_default =
      by_default && std::filesystem::equivalent(database, *by_default, ec) && !ec;
  return is_default ? "" : place_options(database);
}

Status write_ends(const std::vector<Stopped>& runs, const std::string& database) {
  for (const Stopped& run : runs) {
    Notices notices;
    for (const Notice& each : run.notices)
      if (!has_failed(run) || each.code != NoticeCode::failure) notices.push_back(each);
    show_notices(notices, true);
    if (has_failed(run)) continue;
    MDOF_CHECK(write_line(name_of(run) + " has ended" +
                          (run.state.empty() ? "" : " (" + run.state + ")") +
                          "\nshow the run with: mdof show " + std::to_string(run.run) + database));
  }
  return {};
}

Status stop(const StopCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_TRY(const std::string info, client.call("server.info"));
  MDOF_TRY(const auto runs, stop_all(client, info, command));
  MDOF_CHECK(command.json ? write_line(stopped_json(runs))
                          : write_ends(runs, database_option(info)));
  return check_results(runs);
}

Action declare_stop(CLI::App& command) {
  const auto o = std::make_shared<StopCommand>();
  add_only_axis_option(command, o->axis);
  command.add_flag("--abort", o->abort, "Mark the runs as aborted");
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return stop(*o); };
}

}  // namespace

Command stop_command() {
  return {.name = "stop",
          .summary = "End the runs in progress; mdofd evaluates the measured points",
          .footer = "Example:\n  mdof stop --axis X",
          .declare = declare_stop};
}

}  // namespace mdof::tools
