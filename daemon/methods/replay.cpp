// run.replay.
#include "daemon/methods/client_file.h"
#include "daemon/methods/methods.h"
#include "daemon/methods/replayer.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

constexpr rpc::Bounds kPositive = {.least = 0, .most = 1e9};

std::optional<double> optional_number(const Params& params, const char* name) {
  return params.has(name) ? std::optional(params.number(name)) : std::nullopt;
}

Result<ReplayRequest> read_replay_request(const Params& params) {
  ReplayRequest request;
  request.log = params.string("path");
  request.rig_text = params.string("rig");
  if (params.has("rig")) request.rig_source = params.string("rig_source", "rig");
  request.model = params.string("model");
  request.note = params.string("note");
  request.tolerance_um = optional_number(params, "tolerance_um");
  request.settle_s = optional_number(params, "settle_s");
  request.min_length_s = optional_number(params, "min_length_s");
  request.max_gap_s = optional_number(params, "max_gap_s");
  request.lag_bound_s = optional_number(params, "lag_bound_s");
  request.remove_drift = params.boolean("remove_drift", false);
  request.on_the_fly = params.boolean("on_the_fly", false);
  request.interval_mm = optional_number(params, "interval_mm");
  request.bin_mm = optional_number(params, "bin_mm");
  request.from_mm = optional_number(params, "from_mm");
  request.to_mm = optional_number(params, "to_mm");
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

}  // namespace

void add_replay_methods(rpc::MethodTable& table, Methods& m) {
  table.add(
      {.name = "run.replay",
       .summary = "Replays a log or a recording and stores its run, one at a time.",
       .params =
           {{"path",
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
            {"tolerance_um",
             ParamType::number,
             "encoder at rest; 0: by itself",
             false,
             {},
             kPositive},
            {"settle_s",
             ParamType::number,
             "left out at the start of a stop",
             false,
             {},
             kPositive},
            {"min_length_s",
             ParamType::number,
             "averaged of a stop at least",
             false,
             {},
             kPositive},
            {"max_gap_s",
             ParamType::number,
             "no interpolation into a longer gap",
             false,
             {},
             kPositive},
            {"lag_bound_s",
             ParamType::number,
             "a probe silent for longer is given up",
             false,
             {},
             kPositive},
            {"remove_drift", ParamType::boolean, "takes a significant drift from the errors", false,
             "false"},
            {"on_the_fly", ParamType::boolean, "the axis moves all the time: bins about targets",
             false, "false"},
            {"interval_mm",
             ParamType::number,
             "on the fly, from target to target; 1",
             false,
             {},
             kPositive},
            {"bin_mm",
             ParamType::number,
             "on the fly, what counts about a target; 0: as interval_mm, at most 1",
             false,
             {},
             kPositive},
            {"from_mm", ParamType::number, "on the fly, the first target", false},
            {"to_mm", ParamType::number, "on the fly, none beyond", false},
            {"note", ParamType::string, "for people", false, "\"\""}},
       .result = "run: its id, once it is stored; a long log takes long",
       .example = R"({"path": "/var/lib/mdof/recordings/run-1.mdofrec"})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) { replay_log(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
