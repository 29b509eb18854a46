// Noise of the means at the targets, and the shift that they share, in the trials of a block.
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
  // The factor that turns the normal numbers of one trial into those of Student's t: √(ν/χ²), by
  // Wilson and Hilferty.
  double student(std::size_t trial, double freedom) const;

 private:
  const Repeatability& random_;
  // Normal numbers for each target, then for the shift; by trial.
  std::vector<std::vector<double>> drawn_;
  // For each part that changes several targets.
  std::vector<const std::vector<Errors5>*> parts_;
  std::vector<std::vector<double>> together_;
  std::vector<double> for_freedom_;
};

}  // namespace mdof::algo
