#include "daemon/output/report/replay_command.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "daemon/measure/replay/request_json.h"
#include "daemon/output/charts/svg.h"
#include "daemon/words/shell_word.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/units.h"

namespace mdof::report {
namespace {

std::string option(const char* name, double value) {
  return std::string(" ") + name + " " + charts::exact_text(value);
}

// Writes all options, including those with default values. Otherwise the options in the recording
// would apply.
std::string options_of(const daemon::PipelineOptions& o) {
  std::string text = std::string(" --model ") + to_string(o.model) +
                     option("--max-gap-s", o.align.max_gap_s) +
                     option("--lag-bound-s", o.align.lag_bound_s);
  if (!o.on_the_fly)  // only a run with stops has these options
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
  // If the interval is 0, mdof calculates it from the targets or from the travel.
  if (o.on_the_fly->interval_mm > 0) text += option("--interval-mm", o.on_the_fly->interval_mm);
  if (o.on_the_fly->bin_mm > 0) text += option("--bin-mm", o.on_the_fly->bin_mm);
  if (o.on_the_fly->from_mm) text += " --from-mm " + charts::exact_text(*o.on_the_fly->from_mm);
  if (o.on_the_fly->to_mm) text += " --to-mm " + charts::exact_text(*o.on_the_fly->to_mm);
  return text;
}

std::string import_options(const Run& run) {
  const RunHeader& h = run.header;
  std::string text = std::string(" --axis ") + letter(h.axis) + " --error " + h.provenance.model;
  const double u = run.points.empty() ? std::nan("") : deviation_uncertainty(run.points.front());
  if (std::isfinite(u))
    text += option(imported_run_error(h).angle ? "--u-urad" : "--u-um", to_key_unit(u));
  constexpr std::string_view kKind = "imported ";  // the name of the format follows
  if (h.provenance.recording_kind.starts_with(kKind))
    text += " --format " + h.provenance.recording_kind.substr(kKind.size());
  const RunOptions options = run_options(h);
  if (options.limit_um) text += option("--limit-um", *options.limit_um);
  if (options.limit_um_per_mm) text += option("--limit-um-per-mm", *options.limit_um_per_mm);
  if (std::any_of(h.notices.begin(), h.notices.end(),
                  [](const Notice& n) { return n.severity != Severity::information; }))
    text += " --despite-warnings";
  if (h.provenance.model != positioning_name(h.axis)) return text;
  const ImportedSense stated = options.imported;
  text += std::string(" --sense ") + to_string(stated.sense);
  if (stated.against_command) text += *stated.against_command ? " --travel -" : " --travel +";
  return text;
}

}  // namespace

std::string rig_file(const RunHeader& run) {
  return run.provenance.rig_text.empty() ? "" : "rig-of-run-" + std::to_string(run.id) + ".toml";
}

std::string replay_command(const Run& of) {
  const RunHeader& run = of.header;
  if (is_imported(run))
    return "mdof import " + words::quoted_for_shell(run.provenance.recording_path) +
           import_options(of) + " --db check.db";
  const bool was_piped = run.provenance.recording_path == "-";
  std::string command =
      "mdof replay " + (was_piped ? "-" : words::quoted_for_shell(run.provenance.recording_path));
  if (const std::string rig = rig_file(run); !rig.empty()) command += " --rig " + rig;
  if (const auto options = daemon::read_options_json(run.provenance.options_json, {}))
    command += options_of(*options);
  return command + " --db check.db" + (was_piped ? " < LOG.csv" : "");
}

}  // namespace mdof::report
