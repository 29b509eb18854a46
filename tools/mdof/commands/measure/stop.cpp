// mdof stop: ends the runs under way, through mdofd, which evaluates and stores them.
#include <CLI/CLI.hpp>

#include "daemon/rpc/line/client.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"

namespace mdof::tools {
namespace {

using simdjson::dom::element;

struct StopCommand {
  std::string socket, axis;
  bool abort = false, json = false;
};

struct UnderWay {
  std::string axis;
  std::int64_t run = 0;
};

// Error: the axis asked for is none of mdofd's.
Result<std::vector<UnderWay>> runs_under_way(const std::string& info, const std::string& axis) {
  simdjson::dom::parser parser;
  std::vector<UnderWay> runs;
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
Result<std::vector<UnderWay>> stop_all(rpc::Client& client, const std::string& info,
                                       const StopCommand& command) {
  MDOF_TRY(auto runs, runs_under_way(info, command.axis));
  if (runs.empty())
    return fail(ErrorCode::not_found,
                "no run" + (command.axis.empty() ? "" : " of axis " + command.axis) +
                    " is in progress; to list the runs that have ended, use: mdof runs");
  for (UnderWay& run : runs) {
    JsonWriter params;
    params.begin_object().field("run", run.run).field("abort", command.abort).end_object();
    MDOF_TRY(const std::string reply, client.call("run.stop", params.text()));
    simdjson::dom::parser parser;
    const auto stopped = parser.parse(simdjson::padded_string(reply));
    run.run = integer(stopped, "run").value_or(run.run);  // another one may supersede it
  }
  return runs;
}

std::string stopped_json(const std::vector<UnderWay>& runs) {
  JsonWriter json;
  json.begin_object().key("stopped").begin_array();
  for (const auto& run : runs)
    json.begin_object().field("run", run.run).field("axis", run.axis).end_object();
  json.end_array().end_object();
  return json.take();
}

Status stop(const StopCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_TRY(const std::string info, client.call("server.info"));
  MDOF_TRY(const auto runs, stop_all(client, info, command));
  if (command.json) return write_line(stopped_json(runs));
  // A mdofd at another socket has another database than the one that mdof show reads by itself.
  simdjson::dom::parser parser;
  const std::string database =
      command.socket.empty()
          ? ""
          : " --db " + text(parser.parse(simdjson::padded_string(info)), "database");
  for (const auto& run : runs)
    MDOF_CHECK(write_line("run " + std::to_string(run.run) + " of axis " + run.axis +
                          " has ended; show the run with: mdof show " + std::to_string(run.run) +
                          database));
  return {};
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
