// Calculates how the means at the targets change if the errors of the points change. The means of
// target_means() for both approaches are linear in the errors of the points.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "algo/sequence/run_drifts.h"
#include "schema/point.h"

namespace mdof::algo {

// Constructed once from the points; of() may then be called many times.
class TargetChanges {
 public:
  TargetChanges(const MovingAxis& moving, const std::vector<MeasuredPoint>& points);

  // `changes`: change of the local errors of each point; m, rad. Returns the change of
  // TargetMean::named for the moving body, in the order of target_means().
  std::vector<Errors5> of(const std::vector<Errors5>& changes) const;

 private:
  struct Counted {
    std::size_t target, way, point;  // way: 0: forward, 1: reverse
  };
  // Number of visits of a target, forward and reverse.
  using Visits = std::array<std::size_t, 2>;
  using Ways = std::array<std::vector<Errors5>, 2>;  // [way][target]

  std::vector<Errors5> without_drift(const std::vector<Errors5>& changes) const;
  Ways direction_means(const std::vector<Errors5>& errors) const;
  Errors5 mean_reversal(const Ways& ways) const;

  MovingAxis moving_;
  std::vector<Counted> counted_;
  std::vector<Visits> visits_;
  std::optional<RunDrifts> drifts_;  // set if visits of some runs are missing
};

}  // namespace mdof::algo
