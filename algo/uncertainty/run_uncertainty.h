// The uncertainty of the five errors of each point of a run, of its noise and of what its rig
// declares.
#pragma once

#include <array>
#include <vector>

#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/statistics/visit_scatter.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::algo {

// Of the errors as the run states them. GUM 5.1.2: the squares of what is random and of each
// contributor's part add. Random is the noise of the point's own stop (degrees of freedom: its
// scans less one), or, where it is more, the variance of a visit that repeats of the targets show
// (visit_scatter.h): it replaces that noise, which is part of it. What changes in proportion to
// time is no repeatability where the declared drift explains it; where it is more than such a drift
// shows by chance in one of a thousand runs, all of it is, less what the declared drift does. A
// removed drift has the slow noise in its own part, and the noise stays. What the rig declares and
// cannot be calculated leaves the random part alone, and `why` says so.
RunUncertainty run_uncertainty(const Rig& rig, const Run& run);
// A run with more points has none of the repeatability: its pages would take seconds.
inline constexpr std::size_t kMostPointsOfRepeatability = 20'000;

// Without the repeatability: of some points of a run, the first among them, where the drift begins.
RunUncertainty uncertainty_of_stops(const Rig& rig, const Run& part);

// Where not all is declared, u of nothing at all is not known; else it is a declared 0.
void take_zero_as_unknown(RunUncertainty& uncertainty);

// The same step by step, where the contributors are at hand.
class PointUncertainties {
 public:
  // Of what is random alone. Keeps a reference to `run`, which is whole.
  explicit PointUncertainties(const Run& run);
  // `parts`: those of the contributor, made of that run.
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);
  // Takes the noise of the stops for all that is random.
  void leave_out_repeatability();
  VisitsCovered visits() const { return covered_; }
  std::vector<ErrorsUncertainty> stated() const;  // of each point; NaN of one without errors

 private:
  // Of one point and the named errors: the variance of the noise; of the contributors the sum of
  // u_i², and that of u_i⁴/ν_i (GUM G.2b).
  struct Sums {
    Errors5 noise{}, square{}, fourth_by_freedom{};
  };
  const Run& run_;
  std::vector<Sums> sums_;
  VisitScatter visits_;
  VisitsCovered covered_ = VisitsCovered::single;
  VisitScatter::Pooled seen_;                      // of the named errors
  VisitScatter::Pooled steady_;                    // the same without what grows with time
  Errors5 explained_{};                            // of its variance, by the declared drift
  std::array<bool, kErrorCount> repeatability_{};  // whether it is taken
};

}  // namespace mdof::algo
