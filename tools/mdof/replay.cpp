// mdof replay LOG: a recorded log becomes a stored run.
#include "daemon/replay.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "algo/restate.h"
#include "daemon/config.h"
#include "daemon/evaluation.h"
#include "daemon/paths.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/command.h"
#include "tools/mdof/database.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/plausibility_text.h"
#include "tools/mdof/progress.h"
#include "tools/mdof/run_tables.h"

namespace mdof::tools {
namespace {

struct ReplayCommand {
  std::string reference = "fixture";
  std::string log, rig, database, model, note;  // model: empty where not given
  std::optional<double> tolerance_um, settle_s, min_length_s, lag_bound_s, max_gap_s;
  std::vector<double> targets_mm;
  bool json = false, keep_out = false;
};

// As the run was asked for whose recording this is, but for what is given here.
Result<daemon::PipelineOptions> pipeline_options(const ReplayCommand& command,
                                                 const daemon::ReplayLog& log) {
  MDOF_TRY(const auto asked, log.asked_for());
  daemon::PipelineOptions options = asked.options;
  if (!command.model.empty()) model_from(command.model, options.model);
  if (command.tolerance_um) options.dwell.tolerance_m = from_um(*command.tolerance_um);
  options.dwell.settle_s = command.settle_s.value_or(options.dwell.settle_s);
  options.dwell.min_length_s = command.min_length_s.value_or(options.dwell.min_length_s);
  options.align.lag_bound_s = command.lag_bound_s.value_or(options.align.lag_bound_s);
  options.align.max_gap_s = command.max_gap_s.value_or(options.align.max_gap_s);
  if (!command.targets_mm.empty()) options.sequence.targets_m.clear();
  for (const double t : command.targets_mm) options.sequence.targets_m.push_back(from_mm(t));
  std::sort(options.sequence.targets_m.begin(), options.sequence.targets_m.end());
  return options;
}

Result<Rig> rig_of(const ReplayCommand& command, const daemon::ReplayLog& log) {
  if (!command.rig.empty()) return load_rig(command.rig);
  const std::string text = log.rig_text();
  if (!text.empty()) return parse_rig(text, command.log + " (its rig)");
  return fail(ErrorCode::usage,
              command.log + ": is a CSV log, which has no rig in it; give one with --rig RIG.toml");
}

Result<Run> replay_log(const ReplayCommand& command) {
  MDOF_TRY(daemon::ReplayLog log, daemon::ReplayLog::open(command.log));
  MDOF_TRY(const Rig rig, rig_of(command, log));
  std::error_code ec;
  const auto size = std::filesystem::file_size(command.log, ec);
  const double bytes = ec ? 0 : static_cast<double>(size);
  Progress progress("replay", "B");
  MDOF_TRY(const auto options, pipeline_options(command, log));
  return daemon::replay(log, rig, options, [&](double share) { progress.show(share, bytes); });
}

Status store_run(const ReplayCommand& command, Run& run) {
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(run.header.id, store.add_run(run));
  return {};
}

Result<StatedAt> asked_reference(const ReplayCommand& command, const Run& run) {
  Reference reference{};
  reference_from(command.reference, reference);  // the option takes no other
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  return stated_at(rig, reference);
}

Status replay(const ReplayCommand& command) {
  MDOF_TRY(Run run, replay_log(command));
  if (run.header.started_utc.empty()) run.header.started_utc = daemon::utc_now();
  if (!command.note.empty()) run.header.note = command.note;
  MDOF_TRY(const StatedAt at, asked_reference(command, run));
  if (!command.keep_out) MDOF_CHECK(store_run(command, run));
  run = algo::restate(std::move(run), at);  // what is stored is stated at the fixture
  for (const auto& warning : run.header.warnings) warn(warning);
  if (command.json) return write_line(run_json(run));
  run.header.warnings.clear();  // said already
  return write_out(head_text(run.header) + "\n" + points_text(run) + "\n" +
                   straightness_text(run.straightness) + "\n" + angles_text(run.angles) +
                   (run.plausibility ? "\n" + plausibility_text(*run.plausibility) : ""));
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
  add_model_option(*command, o->model);
  add_reference_option(*command, o->reference)->capture_default_str();
  command->add_option("--note", o->note, "Kept with the run")->type_name("TEXT");
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
  add_json_flag(*command, o->json);
  command->footer(
      "A recording is measured as its run was asked for; an option changes that.\n"
      "Example:\n  mdof replay log_X.csv.gz --rig rig_X.toml --json > run.json");
  command->callback([o, &chosen] { chosen = [o] { return replay(*o); }; });
}

}  // namespace mdof::tools
