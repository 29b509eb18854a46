// The uncertainty of the five errors of each point of a run, from its noise and from the
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

// Uncertainty of the errors as the run states them. The squares of the random part and of each part
// of each contributor add (GUM 5.1.2). The random part is the noise of the point's own stop
// (degrees of freedom: its scans less one). If the repeated visits of the targets show a larger
// variance of a visit (visit_scatter.h), this variance replaces the noise, which it includes.
// A change in proportion to time does not count as repeatability if the declared drift explains it.
// If it is larger than such a drift shows by chance in one of a thousand runs, all of it counts,
// less the variance by the declared drift. The part of a removed drift includes the slow noise, so
// the noise of the stop is kept. If the contributors cannot be calculated, only the random part is
// left, and `why` contains the reason.
RunUncertainty run_uncertainty(const Rig& rig, const Run& run);
// Runs with more points omit the repeatability: their pages would take seconds.
inline constexpr std::size_t kRepeatabilityPointLimit = 20'000;

// Without the repeatability. `part`: some points of a run, including its first, where the drift
// begins.
RunUncertainty stop_uncertainty(const Rig& rig, const Run& part);

// Sets u and U from 0 to NaN (unknown), unless all uncertainties are declared and calculated.
void set_zeros_to_unknown(RunUncertainty& uncertainty);

// The same step by step, for callers that have the contributors.
class PointUncertainties {
 public:
  // Starts with the random part. Keeps a reference to `run`, which must be a whole run.
  explicit PointUncertainties(const Run& run);
  // `parts`: the parts of the contributor, calculated for that run.
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);
  // Uses the noise of the stops as the whole random part.
  void leave_out_repeatability();
  VisitsCovered visits() const { return covered_; }
  std::vector<ErrorsUncertainty> stated() const;  // for each point; NaN for a point without errors

 private:
  // Sums for one point and its named errors: the variance of the noise, and for the contributors
  // the sums of u_i² and of u_i⁴/ν_i (GUM G.2b).
  struct Sums {
    Errors5 noise{}, square{}, fourth_by_freedom{};
  };
  const Run& run_;
  std::vector<Sums> sums_;
  VisitScatter visits_;
  VisitsCovered covered_ = VisitsCovered::single;
  VisitScatter::Pooled seen_;    // scatter of the named errors
  VisitScatter::Pooled steady_;  // the same without the change in proportion to time
  Errors5 explained_{};          // the part of this variance that the declared drift explains
  std::array<bool, kErrorCount> repeatability_{};  // whether the error uses it
};

}  // namespace mdof::algo
