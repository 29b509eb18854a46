#include "tools/mdof/study/result.h"

#include <cmath>

#include "daemon/version.h"

namespace mdof::tools {
namespace {

void warn_of_unsolved(StudyResult& result) {
  for (const OutputSummary& s : result.outputs) {
    if (s.unsolved == 0) continue;
    result.warnings.push_back(s.key + ": " + std::to_string(s.unsolved) + " of " +
                              std::to_string(result.trials) +
                              " trials gave no result; the statistics do not contain these trials");
  }
}

// Warns if moments are unknown, because their sums have overflowed or underflowed. This happens if
// the values are spread very much more, or less, than in the first trials (pilot).
void warn_of_lost_moments(StudyResult& result) {
  for (const OutputSummary& s : result.outputs) {
    if (s.n < 2 || std::isfinite(s.mean + s.sd + s.sd_se)) continue;
    result.warnings.push_back(
        s.key +
        ": the mean, the standard deviation or a standard error is unknown, because some values "
        "are far outside the range of the first trials. Extremes, quantiles and intervals are "
        "valid");
  }
}

// Appends the final figures to the convergence, but only in the result. The stored state does not
// contain them; a continued study therefore has the same points as a study without interruption.
void end_convergence(StudyResult& result) {
  for (std::size_t k = 0; k < result.convergence.size(); ++k) {
    auto& points = result.convergence[k].points;
    const OutputSummary& s = result.outputs[k];
    if (!points.empty() && points.back().trials == result.trials) continue;
    points.push_back({result.trials, s.mean, s.sd, s.symmetric.low, s.symmetric.high});
  }
}

}  // namespace

StudyResult result_of(const Study& study, const StudyWork& state, const std::string& started_utc) {
  const StudySettings& settings = study.request.settings;
  const algo::SummaryRequest request{*settings.coverage,
                                     {0.005, 0.025, 0.05, 0.25, 0.5, 0.75, 0.95, 0.975, 0.995}};
  StudyResult result;
  result.name = study.name;
  result.plan_toml = study.request.plan_toml;
  result.software = daemon::kVersion;
  result.started_utc = started_utc;
  result.seed = *settings.seed;
  result.trials = state.trials;
  result.trials_wanted = settings.adaptive ? 0 : *settings.trials;
  result.elapsed_s = state.elapsed_s;
  if (state.trials == 0) return result;
  result.outputs = state.statistics.overall(request);
  if (study.experiment->binned().bins > 1) {
    result.binned_key = study.experiment->binned().key;
    result.bins = state.statistics.bins(request);
  }
  result.convergence = state.convergence;
  end_convergence(result);
  warn_of_unsolved(result);
  warn_of_lost_moments(result);
  return result;
}

}  // namespace mdof::tools
