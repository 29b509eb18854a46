#include "daemon/measure/replay_order.h"

#include <algorithm>
#include <cmath>

#include "daemon/measure/config.h"
#include "daemon/measure/delays.h"
#include "daemon/paths.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// What comes over the RPC was not checked by the command line.
Status check_options(const ReplayOrder& order) {
  const auto wrong = [](const char* key, const char* range) {
    return fail(ErrorCode::usage, std::string(key) + " must be " + range);
  };
  const auto below = [](const std::optional<double>& x, double least) {
    return x && !(*x >= least && std::isfinite(*x));
  };
  if (below(order.tolerance_um, 0)) return wrong("tolerance_um", "0 or more");
  if (below(order.settle_s, 0)) return wrong("settle_s", "0 or more");
  constexpr double kShortest_s = 1e-9;
  if (below(order.min_length_s, kShortest_s)) return wrong("min_length_s", "more than 0");
  if (below(order.max_gap_s, kShortest_s)) return wrong("max_gap_s", "more than 0");
  if (below(order.lag_bound_s, kShortest_s)) return wrong("lag_bound_s", "more than 0");
  Model model{};
  if (!order.model.empty() && !model_from(order.model, model))
    return wrong("model", "simplified, exact or rigid");
  return {};
}

Result<PipelineOptions> options_of(const ReplayOrder& order, const ReplayLog& log) {
  MDOF_CHECK(check_options(order));
  MDOF_TRY(const auto asked, log.asked_for());
  PipelineOptions options = asked.options;
  if (!order.model.empty()) model_from(order.model, options.model);
  if (order.tolerance_um) options.dwell.tolerance_m = from_um(*order.tolerance_um);
  options.dwell.settle_s = order.settle_s.value_or(options.dwell.settle_s);
  options.dwell.min_length_s = order.min_length_s.value_or(options.dwell.min_length_s);
  options.align.lag_bound_s = order.lag_bound_s.value_or(options.align.lag_bound_s);
  options.align.max_gap_s = order.max_gap_s.value_or(options.align.max_gap_s);
  if (!order.targets_mm.empty()) options.sequence.targets_m.clear();
  for (const double t : order.targets_mm) options.sequence.targets_m.push_back(from_mm(t));
  std::sort(options.sequence.targets_m.begin(), options.sequence.targets_m.end());
  return options;
}

// With the delays of a rig that is given instead of the recorded one, or beside a CSV log.
Result<PipelineOptions> delayed(PipelineOptions options, const ReplayOrder& order,
                                const ReplayLog& log, const Rig& rig) {
  const std::string recorded = log.rig_text();
  Rig before;
  if (!recorded.empty()) {
    MDOF_TRY(before, parse_rig(recorded, order.log + " (its rig)"));
  }
  options = with_delays_of(rig, before, std::move(options));
  if (const auto settles = check_settling(options); !settles)
    return fail(ErrorCode::usage, settles.error().message);
  return options;
}

Result<Rig> rig_of(const ReplayOrder& order, const ReplayLog& log) {
  if (!order.rig_source.empty()) return parse_rig(order.rig_text, order.rig_source);
  const std::string text = log.rig_text();
  if (!text.empty()) return parse_rig(text, order.log + " (its rig)");
  return fail(ErrorCode::usage,
              order.log + ": is a CSV log, which has no rig in it; give one with --rig RIG.toml");
}

}  // namespace

Result<Run> replay(const ReplayOrder& order, const ReplayProgress& progress) {
  MDOF_TRY(ReplayLog log, ReplayLog::open(order.log));
  MDOF_TRY(const Rig rig, rig_of(order, log));
  MDOF_TRY(auto asked, options_of(order, log));
  MDOF_TRY(const auto options, delayed(std::move(asked), order, log, rig));
  MDOF_TRY(Run run, replay(log, rig, options, progress));
  if (run.header.started_utc.empty()) run.header.started_utc = utc_now();
  if (!order.note.empty()) run.header.note = order.note;
  return run;
}

}  // namespace mdof::daemon
