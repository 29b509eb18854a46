// Random errors of the means at the targets in a block of trials: noise of each mean, and errors
// that several means have in common.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/uncertainty/budget/budget_draws.h"
#include "algo/uncertainty/budget/figures.h"
#include "algo/uncertainty/statistics/repeatability.h"

namespace mdof::algo {

class TargetNoise {
 public:
  // Keeps a reference to `random`.
  TargetNoise(BlockOfDraws& draws, const Repeatability& random);
  void add_to(MeanErrors& means, std::size_t trial, double factor) const;
  // student_factor() of one trial.
  double student(std::size_t trial, double freedom) const;

 private:
  const Repeatability& random_;
  // Standard normal random numbers: drawn_[i][trial] for target i, and in the last row for the
  // shift.
  std::vector<std::vector<double>> drawn_;
  // The parts that change several means together, and their random numbers together_[part][trial].
  std::vector<const std::vector<Errors5>*> parts_;
  std::vector<std::vector<double>> together_;
  std::vector<double> for_freedom_;
};

}  // namespace mdof::algo
