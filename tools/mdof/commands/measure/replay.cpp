// mdof replay LOG: a recorded log becomes a stored run.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "algo/model/restate.h"
#include "daemon/history.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/replay/replay_request.h"
#include "daemon/words/words.h"
#include "schema/rig/calibrated.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::hours kReplayPatience{24};  // mdofd says nothing before a log is done

struct ReplayCommand {
  std::string reference = "fixture";
  std::string log, rig, database, socket, model, note;  // model: empty where not given
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  std::optional<double> interval_mm, bin_mm, from_mm, to_mm;
  bool on_the_fly = false, remove_drift = false, json = false, keep_out = false,
       all_warnings = false;
};

Result<daemon::ReplayRequest> request_of(const ReplayCommand& c) {
  daemon::ReplayRequest request;
  request.log = c.log;
  request.rig_source = c.rig;
  if (!c.rig.empty()) {
    MDOF_TRY(request.rig_text, load_rig_text(c.rig));
  }
  request.model = c.model;
  request.note = c.note;
  request.tolerance_um = c.tolerance_um;
  request.settle_s = c.settle_s;
  request.min_length_s = c.min_length_s;
  request.lag_bound_s = c.lag_bound_s;
  request.max_gap_s = c.max_gap_s;
  request.targets_mm = c.targets_mm;
  request.remove_drift = c.remove_drift;
  request.on_the_fly = c.on_the_fly;
  request.interval_mm = c.interval_mm;
  request.bin_mm = c.bin_mm;
  request.from_mm = c.from_mm;
  request.to_mm = c.to_mm;
  return request;
}

Result<Run> replay_here(const daemon::ReplayRequest& request) {
  ProgressBar bar("replay");
  return daemon::replay(request, [&](const Progress& progress) {
    bar.show(progress);
    return true;
  });
}

std::string params_of(const daemon::ReplayRequest& request, const std::string& path) {
  JsonWriter json;
  json.begin_object().field("path", path).field("note", request.note);
  if (!request.rig_source.empty())
    json.field("rig", request.rig_text).field("rig_source", request.rig_source);
  if (!request.model.empty()) json.field("model", request.model);
  const auto number = [&](const char* key, const std::optional<double>& value) {
    if (value) json.field(key, *value);
  };
  number("tolerance_um", request.tolerance_um);
  number("settle_s", request.settle_s);
  number("min_length_s", request.min_length_s);
  number("max_gap_s", request.max_gap_s);
  number("lag_bound_s", request.lag_bound_s);
  if (request.remove_drift) json.field("remove_drift", true);
  if (request.on_the_fly) json.field("on_the_fly", true);
  number("interval_mm", request.interval_mm);
  number("bin_mm", request.bin_mm);
  number("from_mm", request.from_mm);
  number("to_mm", request.to_mm);
  json.key("targets_mm").begin_array();
  for (const double target_mm : request.targets_mm) json.value(target_mm);
  json.end_array().end_object();
  return json.take();
}

// mdofd has the database: it reads the log, computes and stores.
Result<Run> replay_there(rpc::Client& mdofd, const ReplayCommand& command,
                         const daemon::ReplayRequest& request) {
  if (request.log == "-")
    return fail(ErrorCode::conflict,
                "mdofd holds the database and cannot read the standard input of this program; "
                "write the log to a file, or name another database with --db");
  std::error_code ec, none;
  std::string path = std::filesystem::canonical(request.log, none);  // mdofd follows no link
  if (none) path = std::filesystem::absolute(request.log, ec);
  const auto reply = mdofd.call("run.replay", params_of(request, path), kReplayPatience);
  if (!reply) return in_context("mdofd", reply.error());
  simdjson::dom::parser parser;
  const auto id = integer(parser.parse(simdjson::padded_string(*reply)), "run");
  MDOF_TRY(store::Store store, open_to_read(command.database));
  return store.run(id.value_or(0));
}

Result<StatedAt> asked_reference(const ReplayCommand& command, const Run& run) {
  Reference reference{};
  reference_from(command.reference, reference);  // the option takes no other
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  return stated_at(rig, reference);
}

Result<Run> replay_and_store(const ReplayCommand& command, const daemon::ReplayRequest& request) {
  MDOF_TRY(auto mdofd, mdofd_that_writes(command.database, command.socket));
  if (mdofd) return replay_there(*mdofd, command, request);
  MDOF_TRY(Run run, replay_here(request));
  MDOF_CHECK(asked_reference(command, run));  // what cannot be shown is not stored
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(run.header.id, store.add_run(run, daemon::deed_now("run.replay", daemon::this_process()),
                                        daemon::uncertainty_of(run)));
  return run;
}

Status replay(const ReplayCommand& command) {
  MDOF_TRY(const auto request, request_of(command));
  MDOF_TRY(Run run, command.keep_out ? replay_here(request) : replay_and_store(command, request));
  MDOF_TRY(const StatedAt at, asked_reference(command, run));
  run = algo::restate(std::move(run), at);  // what is stored is stated at the fixture
  show_notices(run.header.notices, command.all_warnings);
  if (command.json) {
    const daemon::StatedRun stated = daemon::stated_run(run);
    return write_line(run_json(run, stated.points, stated.figures, words::text));
  }
  run.header.notices.clear();  // shown already
  const daemon::StatedRun stated = daemon::stated_run(run);
  return write_out(show_text(run, stated.points, "", terminal_columns()) + "\n" +
                   figures_text(run, stated.figures, terminal_columns()));
}

void add_on_the_fly_options(CLI::App& command, ReplayCommand& o) {
  auto* on_the_fly = command.add_flag(
      "--on-the-fly", o.on_the_fly,
      "The axis moves all the time: each point is of the readings about its target");
  command.add_option("--interval-mm", o.interval_mm, "On the fly: from target to target [1]")
      ->check(positive_number())
      ->needs(on_the_fly);
  command
      .add_option("--bin-mm", o.bin_mm,
                  "On the fly: length about a target [the interval, at most 1]")
      ->check(positive_number())
      ->needs(on_the_fly);
  command.add_option("--from-mm", o.from_mm, "On the fly: the first target [as the axis goes]")
      ->needs(on_the_fly);
  command.add_option("--to-mm", o.to_mm, "On the fly: no target beyond [as the axis goes]")
      ->needs(on_the_fly);
}

Action declare_replay(CLI::App& command) {
  const auto o = std::make_shared<ReplayCommand>();
  command.add_option("LOG", o->log, "Probe log (CSV, CSV.gz, - for standard input) or .mdofrec")
      ->required()
      ->type_name("");
  command.add_option("--rig", o->rig, "Fixture; a recording has its own")->type_name("RIG.toml");
  add_database_option(command, o->database);
  add_socket_option(command, o->socket);
  add_model_option(command, o->model);
  add_reference_option(command, o->reference)->capture_default_str();
  command.add_option("--note", o->note, "Kept with the run; at most 1024 bytes")
      ->type_name("TEXT")
      ->check([](const std::string& note) {
        return std::string(note.size() <= 1024 ? "" : "a note has at most 1024 bytes");
      });
  command.add_flag("--no-store", o->keep_out, "Only show the result");
  command
      .add_option("--targets-mm", o->targets_mm,
                  "Nominal positions [default: as recorded, else recognised]")
      ->delimiter(',');
  command.add_option("--tolerance-um", o->tolerance_um, "Encoder at rest; 0: by itself")
      ->check(not_negative_number());
  command.add_option("--settle-s", o->settle_s, "Left out at the start of a stop [0.1]")
      ->check(not_negative_number());
  command.add_option("--min-length-s", o->min_length_s, "Averaged of a stop at least [0.1]")
      ->check(positive_number());
  command.add_option("--max-gap-s", o->max_gap_s, "No interpolation into a longer gap [0.05]")
      ->check(positive_number());
  command.add_option("--lag-bound-s", o->lag_bound_s, "A probe silent for longer is given up [3]")
      ->check(positive_number());
  command.add_flag("--remove-drift", o->remove_drift,
                   "Take a significant drift from the errors; its uncertainty is added");
  add_on_the_fly_options(command, *o);
  add_all_warnings_flag(command, o->all_warnings);
  add_json_flag(command, o->json);
  return [o] { return replay(*o); };
}

}  // namespace

Command replay_command() {
  return {.name = "replay",
          .summary = "Turn a recorded log into a stored run",
          .footer =
              "A recording is measured as its run was asked for; an option changes that.\n"
              "Example:\n  mdof replay log_X.csv.gz --rig rig_X.toml --json > run.json",
          .declare = declare_replay};
}

}  // namespace mdof::tools
