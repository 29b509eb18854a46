// Quantile functions of the distributions of a plan (JCGM 101 §6.4): every random number is made of
// one uniform one by the inverse of its distribution function, which keeps stratified, correlated
// and exchanged (Sobol) numbers the same thing.
#pragma once

#include <memory>
#include <vector>

#include "schema/study/plan.h"

namespace mdof::algo {

// Accuracy, relative to the spread: 1e-15 closed forms; normal see gaussian(); t 4e-9 of the value
// (cubic interpolation between exact nodes 1/256 of a standard deviation of the normal score
// apart); empirical exact: value r of n sorted ones is the quantile at (r - 1/2)/n, linear between,
// ends held.
class QuantileFunction {
 public:
  explicit QuantileFunction(const Distribution& distribution);

  double at(double p) const;  // p in (0, 1)
  // At p = Φ(score): for correlated quantities. For normal and t without a detour by p.
  double at_score(double score) const;

  // What a tolerance of this distribution is called by: |value| of a constant, standard deviation,
  // scale of t, the largest |value| of a limited one.
  double size() const;

 private:
  struct StudentTable;
  double t_at_score(double score) const;
  double trapezoidal(double p) const;
  double empirical(double p) const;

  Distribution d_;
  std::shared_ptr<const StudentTable> table_;  // t only
};

}  // namespace mdof::algo
