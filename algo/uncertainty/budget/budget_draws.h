// The random numbers for the trials of a budget (JCGM 101 6.4), for a block of trials.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algo/sensitivity/distribution.h"
#include "algo/sensitivity/random.h"
#include "schema/rig/uncertainty.h"

namespace mdof::algo {

// The distribution of a quantity with the standard uncertainty 1. For few degrees of freedom it is
// Student's t distribution (6.4.9).
class UnitQuantity {
 public:
  explicit UnitQuantity(const DeclaredUncertainty& declared);
  // Student's t distribution; the normal distribution for infinite `freedom`.
  explicit UnitQuantity(double freedom);

  // Replaces each probability in `p` by its quantile.
  void quantiles(std::span<double> p) const;

 private:
  bool normal_ = false;
  QuantileFunction quantile_;
};

// Factor √(ν/χ²) that converts normal numbers to numbers of Student's t distribution, with χ² from
// a standard normal number by the approximation of Wilson and Hilferty.
double student_factor(double normal, double freedom);

// Draws one quantity after the other. The numbers are those of draw().
class BlockOfDraws {
 public:
  // For the trials first ... first + trials - 1.
  BlockOfDraws(const Stream& from, std::uint64_t first, std::uint64_t trials);
  // Values of the next quantity, one for each trial. Without argument: probabilities.
  std::vector<double> next();
  std::vector<double> next(const UnitQuantity& quantity);

 private:
  Stream from_;
  std::uint64_t first_ = 0, quantity_ = 0;
  std::array<std::vector<double>, 2> pair_;
};

}  // namespace mdof::algo
