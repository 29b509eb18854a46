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

std::string option(const char* name, double value) {
  return std::string(" ") + name + " " + charts::exact_text(value);
}

// All of them, whatever the defaults are: a recording has options of its own, which would hold.
std::string options_of(const daemon::PipelineOptions& o) {
  std::string text = std::string(" --model ") + to_string(o.model) +
                     option("--max-gap-s", o.align.max_gap_s) +
                     option("--lag-bound-s", o.align.lag_bound_s);
  if (!o.on_the_fly)  // which has no stops
    text += option("--tolerance-um", to_um(o.dwell.tolerance_m)) +
            option("--settle-s", o.dwell.settle_s) + option("--min-length-s", o.dwell.min_length_s);
  if (!o.sequence.targets_m.empty()) {
    text += " --targets-mm";
    for (const double target_m : o.sequence.targets_m)
      text += " " + charts::exact_text(to_mm(target_m));
  }
  if (o.remove_drift) text += " --remove-drift";
  if (!o.on_the_fly) return text;
  text += " --on-the-fly";
  // 0: as it was given targets, or as the travel says.
  if (o.on_the_fly->interval_mm > 0) text += option("--interval-mm", o.on_the_fly->interval_mm);
  if (o.on_the_fly->bin_mm > 0) text += option("--bin-mm", o.on_the_fly->bin_mm);
  if (o.on_the_fly->from_mm) text += " --from-mm " + charts::exact_text(*o.on_the_fly->from_mm);
  if (o.on_the_fly->to_mm) text += " --to-mm " + charts::exact_text(*o.on_the_fly->to_mm);
  return text;
}

}  // namespace

std::string rig_file(const RunHeader& run) {
  return run.provenance.rig_text.empty() ? "" : "rig-of-run-" + std::to_string(run.id) + ".toml";
}

std::string replay_command(const RunHeader& run) {
  const bool was_piped = run.provenance.recording_path == "-";
  std::string command = "mdof replay " + (was_piped ? "-" : quoted(run.provenance.recording_path));
  if (const std::string rig = rig_file(run); !rig.empty()) command += " --rig " + rig;
  if (const auto options = daemon::read_options_json(run.provenance.options_json, {}))
    command += options_of(*options);
  return command + " --db check.db" + (was_piped ? " < LOG.csv" : "");
}

}  // namespace mdof::report
