#include "daemon/measure/replay/replay_request.h"

#include <algorithm>

#include "daemon/measure/configuration/config.h"
#include "daemon/measure/delays.h"
#include "daemon/measure/replay/replay_options.h"
#include "daemon/paths.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// Checks the request here, too, because requests of RPC clients do not pass the checks of the
// command line.
Status check_request(const ReplayRequest& request) {
  MDOF_CHECK(check_replay_options(request));
  Model model{};
  if (!request.model.empty() && !model_from(request.model, model))
    return fail(ErrorCode::usage, "model must be simplified, exact or rigid");
  const bool of_grid = request.interval_mm || request.from_mm || request.to_mm;
  if (!request.targets_mm.empty() && of_grid)
    return fail(ErrorCode::usage,
                "targets_mm and the interval (interval_mm, from_mm, to_mm) both define the "
                "targets; give only one of the two");
  return {};
}

// If the request contains an interval, removes the given or recorded targets. Otherwise the targets
// stay.
Status set_on_the_fly_options(const ReplayRequest& request, PipelineOptions& options) {
  if (!request.on_the_fly) return {};
  algo::OnTheFlyOptions& to = options.on_the_fly.emplace();
  const bool by_interval = request.interval_mm || request.from_mm || request.to_mm;
  if (by_interval) options.sequence.targets_m.clear();
  if (!options.sequence.targets_m.empty()) to.interval_mm = 0;
  to.interval_mm = request.interval_mm.value_or(to.interval_mm);
  to.bin_mm = request.bin_mm.value_or(to.bin_mm);
  to.from_mm = request.from_mm;
  to.to_mm = request.to_mm;
  return algo::check_on_the_fly(to, options.sequence.targets_m);
}

Result<PipelineOptions> options_of(const ReplayRequest& request, const ReplayLog& log) {
  MDOF_CHECK(check_request(request));
  MDOF_TRY(const auto asked, log.asked_for());
  PipelineOptions options = asked.options;
  if (!request.model.empty()) model_from(request.model, options.model);
  if (request.tolerance_um) options.dwell.tolerance_m = from_um(*request.tolerance_um);
  options.remove_drift = options.remove_drift || request.remove_drift;
  options.dwell.settle_s = request.settle_s.value_or(options.dwell.settle_s);
  options.dwell.min_length_s = request.min_length_s.value_or(options.dwell.min_length_s);
  options.align.lag_bound_s = request.lag_bound_s.value_or(options.align.lag_bound_s);
  options.align.max_gap_s = request.max_gap_s.value_or(options.align.max_gap_s);
  if (!request.targets_mm.empty()) options.sequence.targets_m.clear();
  for (const double t : request.targets_mm) options.sequence.targets_m.push_back(from_mm(t));
  auto& targets_m = options.sequence.targets_m;
  std::sort(targets_m.begin(), targets_m.end());
  if (const auto twice = std::adjacent_find(targets_m.begin(), targets_m.end());
      twice != targets_m.end())
    return fail(ErrorCode::usage, "targets_mm contains " + plain_number(to_mm(*twice), 9) +
                                      " mm twice; give each target once");
  MDOF_CHECK(set_on_the_fly_options(request, options));
  return options;
}

// Replaces the delays of the recorded rig by the delays of `rig`. A CSV log has no recorded rig.
Result<PipelineOptions> delayed(PipelineOptions options, const ReplayRequest& request,
                                const ReplayLog& log, const Rig& rig) {
  const std::string recorded = log.rig_text();
  Rig before;
  if (!recorded.empty()) {
    MDOF_TRY(before, parse_rig(recorded, request.log + " (its rig)"));
  }
  options = with_delays_of(rig, before, std::move(options));
  if (options.on_the_fly) return options;  // without stops there is no settling time
  if (auto settles = check_settling(options); !settles) {
    settles.error().code = ErrorCode::usage;
    return tl::unexpected(std::move(settles.error()));
  }
  return options;
}

Result<Rig> rig_of(const ReplayRequest& request, const ReplayLog& log) {
  if (!request.rig_source.empty()) return parse_rig(request.rig_text, request.rig_source);
  const std::string text = log.rig_text();
  if (!text.empty()) return parse_rig(text, request.log + " (its rig)");
  return fail(ErrorCode::usage, request.log + ": a CSV log contains no rig", Remedy::give_rig);
}

}  // namespace

Result<Run> replay(const ReplayRequest& request, const ProgressCallback& progress) {
  MDOF_TRY(ReplayLog log, ReplayLog::open(request.log, request.opened));
  MDOF_TRY(const Rig rig, rig_of(request, log));
  MDOF_TRY(auto asked, options_of(request, log));
  MDOF_TRY(const auto options, delayed(std::move(asked), request, log, rig));
  MDOF_TRY(Run run, replay(log, rig, options, progress));
  if (run.header.started_utc.empty()) run.header.started_utc = rig.report.date;
  if (run.header.started_utc.empty()) run.header.started_utc = utc_now();
  if (!request.note.empty()) run.header.note = request.note;
  return run;
}

}  // namespace mdof::daemon
