// The uncertainty of the five errors of each point of a run, of its noise and of what its rig
// declares.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::algo {

// Of the errors as the run states them. GUM 5.1.2: the squares of the noise and of each
// contributor's part add. Degrees of freedom of the noise: the scans of the dwell less one. What
// the rig declares and cannot be reckoned with leaves the noise alone, and `why` says so. Of some
// points of a run alone: its first point must be among them, for the drift begins there.
RunUncertainty run_uncertainty(const Rig& rig, const Run& run);

// The same step by step, where the contributors are at hand.
class PointUncertainties {
 public:
  // Of the noise alone. Keeps a reference to `run`.
  explicit PointUncertainties(const Run& run);
  // `parts`: those of the contributor, made of that run.
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);
  std::vector<ErrorsUncertainty> stated() const;  // of each point; NaN of one without errors

 private:
  // Of one point: the variance of the noise, the sum of u_i², and that of u_i⁴/ν_i (GUM G.2b), of
  // the named errors.
  struct Sums {
    Errors5 noise{}, square{}, fourth_by_freedom{};
    void add(const Errors5& variance, double freedom);
  };
  const Run& run_;
  std::vector<Sums> sums_;
};

}  // namespace mdof::algo
