// mdof replay LOG: evaluates a recorded log and stores the run.
#include <CLI/CLI.hpp>

#include "algo/model/restate.h"
#include "daemon/history.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/replay/known_trouble.h"
#include "daemon/measure/replay/replay_document.h"
#include "daemon/measure/replay/replay_options.h"
#include "schema/base/json_writer.h"
#include "schema/rig/calibrated.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/progress_bar.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/run_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

using daemon::ReplayOption;

struct ReplayCommand {
  std::string reference = "fixture";
  daemon::ReplayRequest request;
  std::string rig, database, socket;
  bool json = false, keep_out = false, all_warnings = false, all = false;
};

Result<Run> replay_locally(const daemon::ReplayRequest& request) {
  ProgressBar bar("replay");
  return daemon::replay(request, [&](const Progress& progress) {
    bar.show(progress);
    return true;
  });
}

std::string params_of(const daemon::ReplayRequest& request) {
  JsonWriter json;
  json.begin_object().field("path", canonical_path(request.log)).field("note", request.note);
  if (!request.rig_source.empty())
    json.field("rig", request.rig_text).field("rig_source", request.rig_source);
  if (!request.model.empty()) json.field("model", request.model);
  for (const ReplayOption& option : daemon::replay_options()) {
    if (const auto* number = std::get_if<ReplayOption::Number>(&option.member)) {
      if (request.*(*number)) json.field(option.name, *(request.*(*number)));
    } else if (request.*std::get<ReplayOption::Switch>(option.member)) {
      json.field(option.name, true);
    }
  }
  json.key("targets_mm").begin_array();
  for (const double target_mm : request.targets_mm) json.value(target_mm);
  json.end_array().end_object();
  return json.take();
}

// If mdofd uses the database, mdofd reads the log, evaluates it, and stores the run.
Result<Run> replay_in_daemon(rpc::Client& mdofd, const ReplayCommand& command) {
  const daemon::ReplayRequest& request = command.request;
  if (request.log == "-")
    return fail(ErrorCode::conflict,
                "mdofd uses the database and cannot read the standard input of this program; write "
                "the log to a file, or give another database with --db");
  return store_in_daemon(mdofd, command.database, "run.replay", params_of(request));
}

Result<StatedAt> requested_reference(const ReplayCommand& command, const Run& run) {
  Reference reference{};
  reference_from(command.reference, reference);  // the option accepts only valid names
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  return stated_at(rig, reference);
}

Result<Run> replay_and_store(const ReplayCommand& command) {
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  if (mdofd) return replay_in_daemon(*mdofd, command);
  MDOF_TRY(Run run, replay_locally(command.request));
  // Before storing: a run that cannot be shown is not stored.
  MDOF_CHECK(requested_reference(command, run));
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_CHECK(daemon::add_known_trouble(store, run));
  MDOF_TRY(run.header.id,
           store.add_run(run, daemon::action_now("run.replay", daemon::this_process()),
                         daemon::uncertainty_of(run)));
  return run;
}

Status replay(ReplayCommand command) {
  command.request.rig_source = command.rig;
  if (!command.rig.empty()) {
    MDOF_TRY(command.request.rig_text, load_rig_text(command.rig));
  }
  MDOF_TRY(Run run, command.keep_out ? replay_locally(command.request) : replay_and_store(command));
  MDOF_TRY(const StatedAt at, requested_reference(command, run));
  run = algo::restate(std::move(run), at);  // errors in the database refer to the fixture
  show_notices(run.header.notices, command.all_warnings);
  if (command.json) return write_line(daemon::replay_document(run, daemon::stated_run(run)));
  run.header.notices.clear();  // they were shown already
  return write_out(run_text(run, daemon::stated_run(run), "", terminal_columns(),
                            command.all ? Extent::all : Extent::brief));
}

void add_option(CLI::App& command, const ReplayOption& option, daemon::ReplayRequest& request) {
  const std::string name = option.command_line_name();
  if (const auto* yes = std::get_if<ReplayOption::Switch>(&option.member)) {
    command.add_flag(name, request.*(*yes), option.meaning);
    return;
  }
  auto* added = command.add_option(name, request.*std::get<ReplayOption::Number>(option.member),
                                   option.meaning);
  using Range = ReplayOption::Range;
  added->check(option.range == Range::any            ? finite_number()
               : option.range == Range::not_negative ? not_negative_number()
                                                     : positive_number());
  if (option.of == ReplayOption::Of::motion) added->needs("--on-the-fly");
}

Action declare_replay(CLI::App& command) {
  const auto o = std::make_shared<ReplayCommand>();
  command
      .add_option("LOG", o->request.log,
                  "Probe log (CSV, CSV.gz, - for standard input) or recording (.mdofrec)")
      ->required()
      ->type_name("");
  command
      .add_option("--rig", o->rig,
                  "Rig file, which describes probes and axis [default if LOG is a recording: the "
                  "rig stored in this recording]")
      ->type_name("RIG.toml");
  add_database_option(command, o->database);
  add_socket_option(command, o->socket);
  add_model_option(command, o->request.model);
  add_reference_option(command, o->reference)->capture_default_str();
  command.add_option("--note", o->request.note, "Note stored with the run; at most 1024 bytes")
      ->type_name("TEXT")
      ->check([](const std::string& note) {
        return std::string(note.size() <= 1024 ? "" : "a note has at most 1024 bytes");
      });
  command.add_flag("--no-store", o->keep_out, "Show the result without storing it");
  command
      .add_option("--targets-mm", o->request.targets_mm,
                  "Target positions [default: targets of the recording, else targets recognised "
                  "from the stops]")
      ->delimiter(',');
  for (const ReplayOption& option : daemon::replay_options())
    add_option(command, option, o->request);
  command.add_flag(
      "--all", o->all,
      "Show all points, the figures of each approach and reference line, and the drift");
  add_all_warnings_flag(command, o->all_warnings);
  add_json_flag(command, o->json);
  return [o] { return replay(*o); };
}

}  // namespace

Command replay_command() {
  return {.name = "replay",
          .summary = "Evaluate a recorded log and store the result as a run",
          .footer =
              "mdof evaluates a recording with the options of the original run. Options of this "
              "command replace the original options.\n"
              "Example:\n"
              "  mdof replay log_X.csv.gz --rig rig_X.toml --json > run.json",
          .declare = declare_replay};
}

}  // namespace mdof::tools
