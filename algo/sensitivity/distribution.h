// Quantile functions of the distributions of a plan (JCGM 101 §6.4). Every random number is
// calculated from one uniform number by the inverse of the distribution function. Therefore
// stratified, correlated and exchanged (Sobol) numbers need no special functions.
#pragma once

#include <memory>
#include <vector>

#include "schema/study/plan.h"

namespace mdof::algo {

// Errors of the quantiles:
//   closed formulas  1e-15 of the spread
//   normal           as gaussian()
//   t                4e-9 of the value; cubic interpolation between exact values, whose normal
//     scores have a distance of 1/256
//   empirical        exact: value r of n sorted values is the quantile at (r - 1/2)/n, linear
//     between two values, constant beyond the first and last value
class QuantileFunction {
 public:
  explicit QuantileFunction(const Distribution& distribution);

  double at(double p) const;  // p in (0, 1)
  // at(Φ(score)), for correlated quantities. For normal and t, p is not calculated.
  double at_score(double score) const;

  // Size of a tolerance with this distribution:
  //   constant  |value|
  //   normal    standard deviation
  //   t         scale
  //   others    largest |value|
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
