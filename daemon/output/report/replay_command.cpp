#include "daemon/output/report/replay_command.h"

#include "daemon/measure/replay/request_json.h"
#include "daemon/output/charts/svg.h"
#include "schema/units.h"

namespace mdof::report {
namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string option(const char* name, double value, double by_default) {
  return value == by_default ? "" : std::string(" ") + name + " " + charts::exact_text(value);
}

std::string options_of(const daemon::PipelineOptions& o) {
  const daemon::PipelineOptions by_default;
  std::string text;
  if (o.model != by_default.model) text += std::string(" --model ") + to_string(o.model);
  text +=
      option("--tolerance-um", to_um(o.dwell.tolerance_m), to_um(by_default.dwell.tolerance_m)) +
      option("--settle-s", o.dwell.settle_s, by_default.dwell.settle_s) +
      option("--min-length-s", o.dwell.min_length_s, by_default.dwell.min_length_s) +
      option("--max-gap-s", o.align.max_gap_s, by_default.align.max_gap_s) +
      option("--lag-bound-s", o.align.lag_bound_s, by_default.align.lag_bound_s);
  if (!o.sequence.targets_m.empty()) {
    text += " --targets-mm";
    for (const double target_m : o.sequence.targets_m)
      text += " " + charts::exact_text(to_mm(target_m));
  }
  if (o.remove_drift) text += " --remove-drift";
  if (!o.on_the_fly) return text;
  const algo::OnTheFlyOptions by_itself;
  text += " --on-the-fly" +
          option("--interval-mm", o.on_the_fly->interval_mm, by_itself.interval_mm) +
          option("--bin-mm", o.on_the_fly->bin_mm, by_itself.bin_mm);
  if (o.on_the_fly->from_mm) text += " --from-mm " + charts::exact_text(*o.on_the_fly->from_mm);
  if (o.on_the_fly->to_mm) text += " --to-mm " + charts::exact_text(*o.on_the_fly->to_mm);
  return text;
}

}  // namespace

std::string rig_file(const RunHeader& run) {
  return run.provenance.recording_kind == "csv" ? "rig-of-run-" + std::to_string(run.id) + ".toml"
                                                : "";
}

std::string replay_command(const RunHeader& run) {
  std::string command = "mdof replay " + quoted(run.provenance.recording_path);
  if (const std::string rig = rig_file(run); !rig.empty()) {
    command += " --rig " + rig;
    const auto options = daemon::read_options_json(run.provenance.options_json, {});
    if (options) command += options_of(*options);
  }
  return command + " --db check.db";
}

}  // namespace mdof::report
