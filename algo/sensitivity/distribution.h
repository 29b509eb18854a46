// Quantile functions of the distributions of a plan (JCGM 101 §6.4). Every random number comes from
// one uniform number by the inverse of the distribution function, so stratified, correlated and
// exchanged (Sobol) numbers need no special case.
#pragma once

#include <memory>
#include <vector>

#include "schema/study/plan.h"

namespace mdof::algo {

// Accuracy relative to the spread: 1e-15 for closed forms; for normal see gaussian(); for t 4e-9 of
// the value (cubic interpolation between exact nodes at distances of 1/256 of a standard deviation
// of the normal score). Empirical is exact: value r of n sorted values is the quantile at (r -
// 1/2)/n, linear between them, constant beyond the ends.
class QuantileFunction {
 public:
  explicit QuantileFunction(const Distribution& distribution);

  double at(double p) const;  // p in (0, 1)
  // At p = Φ(score), for correlated quantities. Normal and t do not calculate p.
  double at_score(double score) const;

  // Size of a tolerance with this distribution: |value| of a constant, standard deviation, scale of
  // t, the largest |value| of a limited distribution.
  double size() const;

 private:
  struct StudentTable;
  double t_at_score(double score) const;
  double trapezoidal(double p) const;
  double empirical(double p) const;

  Distribution d_;
  std::shared_ptr<const StudentTable> table_;  // only for t
};

}  // namespace mdof::algo
