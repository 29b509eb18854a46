// The methods run.replay and run.import: runs from files of clients.
#include "daemon/measure/budgets.h"
#include "daemon/measure/imported/import.h"
#include "daemon/measure/replay/replay_document.h"
#include "daemon/measure/replay/replay_options.h"
#include "daemon/methods/files/client_file.h"
#include "daemon/methods/files/replayer.h"
#include "daemon/methods/methods.h"
#include "daemon/run_item.h"

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

Result<std::optional<PositioningSense>> sense_param(const Params& params) {
  if (!params.has("sense")) return std::nullopt;
  const std::string text(params.string("sense"));
  if (const auto sense = positioning_sense_from(text)) return sense;
  return fail(ErrorCode::usage, "sense \"" + text + "\" must be \"command\" or \"body\"");
}

// Parameter "travel". True ("-"): the body moves towards - when the command increases.
Result<std::optional<bool>> travel_param(const Params& params) {
  if (!params.has("travel")) return std::nullopt;
  const std::string text(params.string("travel"));
  if (text == "+" || text == "-") return text == "-";
  return fail(ErrorCode::usage, "travel \"" + text + "\" must be \"+\" or \"-\"");
}

Result<ImportRequest> read_import_request(const Params& params) {
  ImportRequest request;
  request.file = params.string("path");
  MDOF_TRY(request.axis, axis_param(params));
  request.error = params.string("error");
  request.format = params.string("format");
  MDOF_TRY(request.sense, sense_param(params));
  MDOF_TRY(request.against_command, travel_param(params));
  if (params.has("u_um")) request.u_um = params.number("u_um");
  if (params.has("u_urad")) request.u_urad = params.number("u_urad");
  request.note = params.string("note");
  MDOF_TRY(request.limits, limits_param(params));
  request.despite_warnings = params.boolean("despite_warnings", false);
  return request;
}

Result<Replayer::Made> replayed(ReplayRequest request, const FileUser& user,
                                const ProgressCallback& progress) {
  MDOF_TRY(const ClientFile opened, open_for(user, request.log));
  request.opened = {opened.file.get(), opened.wal.get()};
  MDOF_TRY(Run run, replay(request, progress));
  StatedRun stated = stated_run(run);
  RunUncertainty uncertainty = stated.points;
  return Replayer::Made{
      std::make_shared<Run>(std::move(run)), std::move(uncertainty),
      [stated = std::move(stated)](const Run& whole) { return replay_reply(whole, stated); }};
}

Result<Replayer::Made> imported(ImportRequest request, const FileUser& user,
                                const ProgressCallback&) {
  MDOF_TRY(const ClientFile opened, open_for(user, request.file));
  request.opened = opened.file.get();
  MDOF_TRY(Run run, imported_run(request));
  RunUncertainty uncertainty = uncertainty_of(run);
  return Replayer::Made{std::make_shared<Run>(std::move(run)), std::move(uncertainty),
                        [](const Run& whole) {
                          return import_document(shortened(whole.header), whole.points.size());
                        }};
}

template <class Request>
using MakeRun = Result<Replayer::Made> (*)(Request, const FileUser&, const ProgressCallback&);

// Opens the file with the permissions of the client. Runs on the thread "replay".
template <class Request>
void store_run(Methods& m, const Params& params, Result<Request> request, MakeRun<Request> make,
               const char* method, Reply reply) {
  const auto who = params.caller().credentials();
  if (!who)
    return reply(
        fail(ErrorCode::usage, std::string(method) + " is available only over the Unix socket"));
  if (!request) return reply(tl::unexpected(request.error()));
  if (!m.replayer)
    return reply(io_error(std::string(method) +
                          " is not available, because this mdofd cannot replay or import files"));
  auto shared = std::make_shared<Reply>(std::move(reply));
  const FileUser user{who->uid, who->gid, params.caller().further_groups()};
  m.replayer->start([request = std::move(*request), user, make](
                        const ProgressCallback& progress) { return make(request, user, progress); },
                    caller_action(params, method),
                    [shared](Result<std::string> document) { (*shared)(std::move(document)); });
}

rpc::Param param_of(const ReplayOption& option) {
  if (std::holds_alternative<ReplayOption::Switch>(option.member))
    return {option.name, ParamType::boolean, option.meaning, false, "false"};
  rpc::Param param{option.name, ParamType::number, option.meaning};
  if (option.range != ReplayOption::Range::any) param.bounds = {.least = 0, .most = 1e9};
  return param;
}

rpc::Param path_param() {
  return {"path",
          ParamType::string,
          "absolute path of a file that both the caller and mdofd may read",
          true,
          {},
          {.bytes = 4096}};
}

std::vector<rpc::Param> replay_params() {
  std::vector<rpc::Param> params{
      path_param(),
      {"rig",
       ParamType::string,
       "rig as TOML text; by default the rig in the recording",
       false,
       "\"\"",
       {.bytes = 60'000}},
      {"rig_source", ParamType::string, "file name of the rig, used in messages", false},
      {"model", ParamType::string, "model for the evaluation: simplified, exact or rigid", false,
       "\"\""},
      {"targets_mm",
       ParamType::array,
       "nominal positions of the targets",
       false,
       "[]",
       {.items = 10'000}},
      {"note", ParamType::string, "free text, stored with the run", false, "\"\""}};
  for (const ReplayOption& option : replay_options()) params.push_back(param_of(option));
  return params;
}

std::vector<rpc::Param> import_params() {
  const rpc::Bounds not_negative{.least = 0, .most = 1e9};
  std::vector<rpc::Param> params{
      path_param(),
      {"axis", ParamType::string, "X, Y or Z", true},
      {"error", ParamType::string,
       "error that was measured, such as EYX [positioning error of the axis, such as EXX]", false,
       "\"\""},
      {"format", ParamType::string,
       "format of the file: csv, iso230-2 or rtl [recognised from the file]", false, "\"\""},
      {"sense", ParamType::string,
       "meaning of a positive positioning error: \"command\": the actual position is greater than "
       "the commanded position; \"body\": the moving body is too far in the + direction of the "
       "machine axis [\"command\"]",
       false},
      {"travel", ParamType::string,
       "direction in which the moving body moves when the commanded position increases: \"+\" or "
       "\"-\" [unknown]",
       false},
      {"u_um",
       ParamType::number,
       "standard uncertainty of each deviation if the error is a length",
       false,
       {},
       not_negative},
      {"u_urad",
       ParamType::number,
       "standard uncertainty of each deviation if the error is an angle",
       false,
       {},
       not_negative},
      {"note", ParamType::string, "free text, stored with the run", false, "\"\""},
      {"despite_warnings", ParamType::boolean,
       "also accept a file that is doubtful because of notices", false, "false"}};
  for (rpc::Param& limit : limit_params()) params.push_back(std::move(limit));
  return params;
}

}  // namespace

void add_files_methods(rpc::MethodTable& table, Methods& m) {
  table.add(
      {.name = "run.replay",
       .summary = "Replays a log or a recording and stores the result as a run. mdofd "
                  "replays one file at a time.",
       .params = replay_params(),
       .result =
           "mdofd replies after it has stored the run, which takes a long time for a long log. To "
           "read the points, call run.points",
       .members = "replayed_run",
       .example = R"({"path": "/var/lib/mdof/recordings/run-1.mdofrec"})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) {
         store_run(m, p, read_replay_request(p), replayed, "run.replay", std::move(r));
       }});
  table.add({.name = "run.import",
             .summary = "Imports a file with the readings of another instrument and stores the "
                        "readings as a run.",
             .params = import_params(),
             .result = "mdofd replies after it has stored the run",
             .members = "{run, axis, error: string, format, readings, file!, sha256, simulated, "
                        "...notices}",
             .example = R"({"path": "/var/lib/mdof/laser_X.rtl", "axis": "X", "u_um": 0.3})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) {
               store_run(m, p, read_import_request(p), imported, "run.import", std::move(r));
             }});
}

}  // namespace mdof::daemon
