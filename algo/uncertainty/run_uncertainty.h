// The uncertainty of the five errors of each point of a run, from the noise of the run and from the
// uncertainties that its rig declares.
#pragma once

#include <array>
#include <vector>

#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/statistics/visit_scatter.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::algo {

// Uncertainty of the errors at the reference point of the run. u² is the sum of the random variance
// and of the squares of all parts of all contributors (GUM 5.1.2). The random variance is the
// larger one of two variances:
//   - noise of the stop of this point; degrees of freedom: number of scans - 1
//   - variance of one visit, from the repeated visits of the targets (visit_scatter.h); it includes
//     the noise of the stop
// The variance of one visit does not contain a change in proportion to time if the declared drift
// explains this change, that is, if such a drift causes a larger change in at least one of a
// thousand runs. Otherwise the variance of one visit contains the whole change, and the variance by
// the declared drift is subtracted. If the drift was removed from the run, the contributor of the
// removed drift includes the slow noise, and the random variance is the noise of the stop. If the
// contributors cannot be calculated, u contains the random variance only, and `why` contains the
// reason.
RunUncertainty run_uncertainty(const Rig& rig, const Run& run);
// For runs with more points, the random variance is the noise of the stop, because the
// repeatability would take seconds to calculate.
inline constexpr std::size_t kRepeatabilityPointLimit = 20'000;

// As run_uncertainty(), but the random variance is always the noise of the stop. `part`: some
// points of a run, including the first point of the run, where the drift begins.
RunUncertainty stop_uncertainty(const Rig& rig, const Run& part);

// Changes u = 0 and U = 0 to NaN (unknown), unless all uncertainties are declared and calculated.
void set_zeros_to_unknown(RunUncertainty& uncertainty);

// Calculates run_uncertainty() in steps, for callers that have the contributors.
class PointUncertainties {
 public:
  // Calculates the random variances. Keeps a reference to `run`, which must be a whole run.
  explicit PointUncertainties(const Run& run);
  // `parts`: the result of contributor.parts() for that run.
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);
  // Uses the noise of the stop as the random variance.
  void leave_out_repeatability();
  VisitsCovered visits() const { return covered_; }
  // One for each point; NaN for a point without errors.
  std::vector<ErrorsUncertainty> stated() const;

 private:
  // For the named errors of one point: variance of the noise; sum of u_i² and sum of u_i⁴/ν_i over
  // the contributors i (GUM G.2b), with the degrees of freedom ν_i.
  struct Sums {
    Errors5 noise{}, square{}, fourth_by_freedom{};
  };
  const Run& run_;
  std::vector<Sums> sums_;
  VisitScatter visits_;
  VisitsCovered covered_ = VisitsCovered::single;
  VisitScatter::Pooled seen_;    // variance of one visit, named errors
  VisitScatter::Pooled steady_;  // variance of one visit without the change in proportion to time
  Errors5 explained_{};          // variance of one visit by the declared drift
  std::array<bool, kErrorCount> repeatability_{};  // false: the random variance of the error is the
                                                   // noise of the stop
};

}  // namespace mdof::algo
