// Random errors, calculated from the visits of a run. Some errors are independent from visit to
// visit. Others are shifts that all targets of a pass have in common; a shift has no effect on a
// figure that is calculated from differences of targets.
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
  // Standard uncertainty of the mean at each target, named errors; independent from target to
  // target.
  std::vector<Errors5> u;
  // Degrees of freedom of u of the errors with by_scatter = true. u of the other errors is
  // calculated from the noise of the dwells, which consist of many readings.
  double freedom = std::numeric_limits<double>::infinity();
  std::array<bool, kErrorCount> by_scatter{};
  // Errors that change several means together, as independent parts: [part][target]. together:
  // uncertainty of the shifts of the runs, if runs lack visits; and u of the change of the reversal
  // along the axis, if targets have only one approach. of_passes: levels of the passes, if runs
  // lack visits.
  std::vector<std::vector<Errors5>> together, of_passes;
  double passes_freedom = std::numeric_limits<double>::infinity();
  // Correlated noise of the errors with by_scatter = true. Its target numbers are indices in
  // `means`.
  std::array<std::optional<CorrelatedNoise>, kErrorCount> correlated;
  Errors5 u_visit{};  // u of one visit, pooled over all targets
  Errors5 u_shift{};  // u of the shift that all means have in common
  double shift_freedom = std::numeric_limits<double>::infinity();
};

// `means`: target_means() of both approaches of these points. The errors of the visits are fitted
// by least squares as the sum of two values: one value for each target and approach, and one value
// for each pass. The variance of the residuals is pooled over all targets. This variance is used as
// the variance of a visit if it exceeds the noise of the dwells significantly (80 % level).
// Otherwise the noise of the dwells is used. u_shift is calculated from the scatter of the values
// of the passes from run to run. If runs lack visits, the means are calculated without the shifts
// of the runs, and u_shift is the uncertainty of the level (uneven_visits.h).
Repeatability repeatability(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                            const std::vector<TargetMean>& means);

}  // namespace mdof::algo
