// mdof replay LOG: a recorded log becomes a stored run.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "algo/model/restate.h"
#include "daemon/doer.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/replay_order.h"
#include "schema/base/files.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/progress.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/holder.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/warnings.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::hours kPatience{24};  // mdofd says nothing before a log is done

struct ReplayCommand {
  std::string reference = "fixture";
  std::string log, rig, database, socket, model, note;  // model: empty where not given
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  bool json = false, keep_out = false, all_warnings = false;
};

Result<daemon::ReplayOrder> order_of(const ReplayCommand& c) {
  daemon::ReplayOrder order;
  order.log = c.log;
  order.rig_source = c.rig;
  if (!c.rig.empty()) {
    MDOF_TRY(order.rig_text, read_text_file(c.rig));
  }
  order.model = c.model;
  order.note = c.note;
  order.tolerance_um = c.tolerance_um;
  order.settle_s = c.settle_s;
  order.min_length_s = c.min_length_s;
  order.lag_bound_s = c.lag_bound_s;
  order.max_gap_s = c.max_gap_s;
  order.targets_mm = c.targets_mm;
  return order;
}

Result<Run> replay_here(const daemon::ReplayOrder& order) {
  std::error_code ec;
  const auto size = std::filesystem::file_size(order.log, ec);
  const double bytes = ec ? 0 : static_cast<double>(size);
  Progress progress("replay", "B");
  return daemon::replay(order, [&](double share) {
    progress.show(share, bytes);
    return true;
  });
}

std::string params_of(const daemon::ReplayOrder& order, const std::string& path) {
  JsonWriter json;
  json.begin_object().field("path", path).field("note", order.note);
  if (!order.rig_source.empty())
    json.field("rig", order.rig_text).field("rig_source", order.rig_source);
  if (!order.model.empty()) json.field("model", order.model);
  const auto number = [&](const char* key, const std::optional<double>& value) {
    if (value) json.field(key, *value);
  };
  number("tolerance_um", order.tolerance_um);
  number("settle_s", order.settle_s);
  number("min_length_s", order.min_length_s);
  number("max_gap_s", order.max_gap_s);
  number("lag_bound_s", order.lag_bound_s);
  json.key("targets_mm").begin_array();
  for (const double target_mm : order.targets_mm) json.value(target_mm);
  json.end_array().end_object();
  return json.take();
}

// mdofd has the database: it reads the log, computes and stores.
Result<Run> replay_there(rpc::Client& mdofd, const ReplayCommand& command,
                         const daemon::ReplayOrder& order) {
  if (order.log == "-")
    return fail(ErrorCode::conflict,
                "mdofd holds the database and cannot read the standard input of this program; "
                "write the log to a file, or name another database with --db");
  std::error_code ec;
  const std::string path = std::filesystem::absolute(order.log, ec);
  const auto reply = mdofd.call("run.replay", params_of(order, path), kPatience);
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

Result<Run> replay_and_store(const ReplayCommand& command, const daemon::ReplayOrder& order) {
  MDOF_TRY(auto mdofd, mdofd_that_holds(command.database, command.socket));
  if (mdofd) return replay_there(*mdofd, command, order);
  MDOF_TRY(Run run, replay_here(order));
  MDOF_CHECK(asked_reference(command, run));  // what cannot be shown is not stored
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(run.header.id,
           store.add_run(run, daemon::deed_now("run.replay", daemon::this_process())));
  return run;
}

Status replay(const ReplayCommand& command) {
  MDOF_TRY(const auto order, order_of(command));
  MDOF_TRY(Run run, command.keep_out ? replay_here(order) : replay_and_store(command, order));
  MDOF_TRY(const StatedAt at, asked_reference(command, run));
  run = algo::restate(std::move(run), at);  // what is stored is stated at the fixture
  for (const auto& warning : summarised(run.header.warnings, command.all_warnings)) warn(warning);
  if (command.json) return write_line(run_json(run));
  run.header.warnings.clear();  // said already
  return write_out(show_text(run, "", terminal_columns()) + "\n" +
                   figures_text(run, terminal_columns()));
}

}  // namespace

void add_replay(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<ReplayCommand>();
  auto* command = app.add_subcommand("replay", "Turn a recorded log into a stored run");
  command->add_option("LOG", o->log, "Probe log (CSV, CSV.gz, - for standard input) or .mdofrec")
      ->required()
      ->type_name("");
  command->add_option("--rig", o->rig, "Fixture; a recording has its own")->type_name("RIG.toml");
  add_database_option(*command, o->database);
  add_socket_option(*command, o->socket);
  add_model_option(*command, o->model);
  add_reference_option(*command, o->reference)->capture_default_str();
  command->add_option("--note", o->note, "Kept with the run; at most 1024 bytes")
      ->type_name("TEXT")
      ->check([](const std::string& note) {
        return std::string(note.size() <= 1024 ? "" : "a note has at most 1024 bytes");
      });
  command->add_flag("--no-store", o->keep_out, "Only show the result");
  command
      ->add_option("--targets-mm", o->targets_mm,
                   "Nominal positions [default: as recorded, else recognised]")
      ->delimiter(',');
  command->add_option("--tolerance-um", o->tolerance_um, "Encoder at rest; 0: by itself")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--settle-s", o->settle_s, "Left out at the start of a stop [0.1]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--min-length-s", o->min_length_s, "Averaged of a stop at least [0.1]")
      ->check(CLI::PositiveNumber);
  command->add_option("--max-gap-s", o->max_gap_s, "No interpolation into a longer gap [0.05]")
      ->check(CLI::PositiveNumber);
  command->add_option("--lag-bound-s", o->lag_bound_s, "A probe silent for longer is given up [3]")
      ->check(CLI::PositiveNumber);
  add_all_warnings_flag(*command, o->all_warnings);
  add_json_flag(*command, o->json);
  command->footer(
      "A recording is measured as its run was asked for; an option changes that.\n"
      "Example:\n  mdof replay log_X.csv.gz --rig rig_X.toml --json > run.json");
  command->callback([o, &chosen] { chosen = [o] { return replay(*o); }; });
}

}  // namespace mdof::tools
