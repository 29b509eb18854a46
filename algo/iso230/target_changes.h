// Change of the means at the targets for given changes of the errors of the points: target_means()
// of both approaches is linear in them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "algo/sequence/run_drifts.h"
#include "schema/point.h"

namespace mdof::algo {

// Prepared once from the points, for any number of changes.
class TargetChanges {
 public:
  TargetChanges(const MovingAxis& moving, const std::vector<MeasuredPoint>& points);

  // `changes`: change of the errors of each point, local; m, rad. Returns the change of `named` of
  // target_means() for the moving body, in the order of its targets.
  std::vector<Errors5> of(const std::vector<Errors5>& changes) const;

 private:
  struct Counted {
    std::size_t target, way, point;  // way: 0 forward, 1 reverse
  };
  using Visits = std::array<std::size_t, 2>;         // visits of a target, forward and reverse
  using Ways = std::array<std::vector<Errors5>, 2>;  // [way][target]

  std::vector<Errors5> without_drift(const std::vector<Errors5>& changes) const;
  Ways direction_means(const std::vector<Errors5>& errors) const;
  Errors5 mean_reversal(const Ways& ways) const;

  MovingAxis moving_;
  std::vector<Counted> counted_;
  std::vector<Visits> visits_;
  std::optional<RunDrifts> drifts_;  // set if runs lack visits
};

}  // namespace mdof::algo
