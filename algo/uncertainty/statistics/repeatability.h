// Random errors that the visits of a run show: errors that are independent from visit to visit, and
// shifts that all targets of a pass have in common, which cancel if a figure takes differences.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "algo/iso230/target_means.h"
#include "algo/uncertainty/statistics/correlated_noise.h"
#include "schema/point.h"

namespace mdof::algo {

struct Repeatability {
  std::vector<Errors5> u;  // u of the means at the targets, independent of each other; named errors
  // For the errors whose u comes from the scatter; the noise of a dwell comes from many readings.
  double freedom = std::numeric_limits<double>::infinity();
  std::array<bool, kErrorCount> by_scatter{};
  // Effects on several means together, as independent parts: [part][target]. `together`:
  // uncertainty of the shifts of runs that lack visits, and the trend of the reversal if targets
  // have one approach. `of_passes`: levels of the passes of such runs.
  std::vector<std::vector<Errors5>> together, of_passes;
  double passes_freedom = std::numeric_limits<double>::infinity();
  // For the errors whose u comes from the scatter; its targets are those of the means.
  std::array<std::optional<CorrelatedNoise>, kErrorCount> correlated;
  Errors5 u_visit{};  // u of one visit, pooled
  Errors5 u_shift{};  // u common to all means
  double shift_freedom = std::numeric_limits<double>::infinity();
};

// `means`: target_means() of both approaches of these points. The least-squares fit error = of the
// target and its approach + of the pass leaves a scatter, which is pooled over all targets. It is
// the variance of a visit if it exceeds the noise of the dwells by more than chance gives in one of
// five logs. The shift is that of the passes from run to run. If runs lack visits, the means are
// calculated without the shifts of the runs, and the shift is the level of uneven_visits.h.
Repeatability repeatability(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                            const std::vector<TargetMean>& means);

}  // namespace mdof::algo
