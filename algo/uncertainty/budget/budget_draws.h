// The random numbers of a budget's trials (JCGM 101 6.4), many trials at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algo/sensitivity/distribution.h"
#include "algo/sensitivity/random.h"
#include "schema/rig/uncertainty.h"

namespace mdof::algo {

// A quantity with the standard uncertainty 1. Few degrees of freedom give Student's t (6.4.9).
class UnitQuantity {
 public:
  explicit UnitQuantity(const DeclaredUncertainty& declared);
  // Normal, or Student's t.
  explicit UnitQuantity(double freedom);

  // Replaces each probability by its quantile.
  void quantiles(std::span<double> p) const;

 private:
  bool normal_ = false;
  QuantileFunction quantile_;
};

// Draws one quantity after another, with the same numbers as draw().
class BlockOfDraws {
 public:
  // For the trials first ... first + trials - 1.
  BlockOfDraws(const Stream& from, std::uint64_t first, std::uint64_t trials);
  // One value for each trial: a probability, or the quantity.
  std::vector<double> next();
  std::vector<double> next(const UnitQuantity& quantity);

 private:
  Stream from_;
  std::uint64_t first_ = 0, quantity_ = 0;
  std::array<std::vector<double>, 2> pair_;
};

}  // namespace mdof::algo
