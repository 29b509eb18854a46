// run.replay.
#include "daemon/measure/replay/replay_options.h"
#include "daemon/methods/client_file.h"
#include "daemon/methods/methods.h"
#include "daemon/methods/replayer.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

Result<ReplayRequest> read_replay_request(const Params& params) {
  ReplayRequest request;
  request.log = params.string("path");
  request.rig_text = params.string("rig");
  if (params.has("rig")) request.rig_source = params.string("rig_source", "rig");
  request.model = params.string("model");
  request.note = params.string("note");
  for (const ReplayOption& option : replay_options()) {
    if (!params.has(option.name)) continue;
    if (const auto* number = std::get_if<ReplayOption::Number>(&option.member))
      request.*(*number) = params.number(option.name);
    else
      request.*std::get<ReplayOption::Switch>(option.member) = params.boolean(option.name, false);
  }
  MDOF_TRY(request.targets_mm, params.numbers("targets_mm"));
  return request;
}

void replay_log(Methods& m, const Params& params, Reply reply) {
  const auto who = params.caller().credentials();
  if (!who) return reply(fail(ErrorCode::usage, "run.replay: only over the Unix socket"));
  auto request = read_replay_request(params);
  if (!request) return reply(tl::unexpected(request.error()));
  if (!m.replayer) return reply(io_error("this daemon replays no logs"));
  auto shared = std::make_shared<Reply>(std::move(reply));
  const FileUser user{who->uid, who->gid, params.caller().further_groups()};
  m.replayer->start(std::move(*request), user, deed_of(params, "run.replay"),
                    [shared](const Result<std::int64_t>& id) {
                      if (!id) return (*shared)(tl::unexpected(id.error()));
                      JsonWriter json;
                      json.begin_object().field("run", *id).end_object();
                      (*shared)(json.take());
                    });
}

rpc::Param param_of(const ReplayOption& option) {
  if (std::holds_alternative<ReplayOption::Switch>(option.member))
    return {option.name, ParamType::boolean, option.meaning, false, "false"};
  rpc::Param param{option.name, ParamType::number, option.meaning};
  if (option.range != ReplayOption::Range::any) param.bounds = {.least = 0, .most = 1e9};
  return param;
}

std::vector<rpc::Param> replay_params() {
  std::vector<rpc::Param> params{
      {"path",
       ParamType::string,
       "absolute; a file that caller and daemon may read",
       true,
       {},
       {.bytes = 4096}},
      {"rig",
       ParamType::string,
       "as TOML; of a recording its own by default",
       false,
       "\"\"",
       {.bytes = 60'000}},
      {"rig_source", ParamType::string, "its file name, for messages", false},
      {"model", ParamType::string, "simplified, exact or rigid", false, "\"\""},
      {"targets_mm", ParamType::array, "nominal positions", false, "[]", {.items = 10'000}},
      {"note", ParamType::string, "for people", false, "\"\""}};
  for (const ReplayOption& option : replay_options()) params.push_back(param_of(option));
  return params;
}

}  // namespace

void add_replay_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "run.replay",
             .summary = "Replays a log or a recording and stores its run, one at a time.",
             .params = replay_params(),
             .result = "run: its id, once it is stored; a long log takes long",
             .example = R"({"path": "/var/lib/mdof/recordings/run-1.mdofrec"})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) { replay_log(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
