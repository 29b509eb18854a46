// What the visits of a run show of its random errors: what is independent from visit to visit, and
// shifts that all targets of a pass have in common, which cancel where a figure takes differences.
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
  std::vector<Errors5> u;  // of the means at the targets, independent of each other; named
  // Of those errors whose u is by the scatter; a dwell's noise is that of many readings.
  double freedom = std::numeric_limits<double>::infinity();
  std::array<bool, kErrorCount> by_scatter{};
  // What is not known of the shifts of runs that lack visits, and what levels of their passes do to
  // several means together, by independent parts; and the trend of the reversal, where targets have
  // one approach. [part][target]
  std::vector<std::vector<Errors5>> together, of_passes;
  double passes_freedom = std::numeric_limits<double>::infinity();
  // Of those errors whose u is by the scatter; its targets are those of the means.
  std::array<std::optional<CorrelatedNoise>, kErrorCount> correlated;
  Errors5 u_visit{};  // of a visit, pooled
  Errors5 u_shift{};  // of all means together
  double shift_freedom = std::numeric_limits<double>::infinity();
};

// `means`: target_means() of both approaches of these points. By least squares error = of the
// target and its approach + of the pass: the scatter that this leaves, over all targets together,
// is the variance of a visit where it is larger than the noise of its dwell, by more than one in
// five logs have by chance. The shift is that of the passes from run to run; where runs lack
// visits, so that the means are made without the shifts of the runs, that of these
// (uneven_visits.h).
Repeatability repeatability(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                            const std::vector<TargetMean>& means);

}  // namespace mdof::algo
