// Approximates a correction over a grid of X, Y and Z, for controllers whose tables depend on one
// axis only. The approximation is a sum of functions of one command and of products of two such
// functions.
#pragma once

#include <array>
#include <vector>

#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// The product of two functions: `of_first` has a value for each node of the axis `first`,
// `of_second` for each node of the axis `second`. Unit of both: √m. Both functions have the same
// largest absolute value.
struct AxisProduct {
  std::size_t first = 0, second = 1;
  std::vector<double> of_first, of_second;
};

struct SeparableCorrection {
  std::array<std::vector<double>, 3> along;  // [axis][node], m; empty: no function
  std::vector<AxisProduct> products;
  double left_m = 0;  // largest residual at a node
};

// Approximates the correction of axis k. The functions of one command are means over the other two
// axes. For each pair of axes, products are then added until the residual of the pair is below
// `enough_m`, at most kMostProducts. An effect that depends on all three commands is not
// approximated. In a machine with linear axes, such an effect is of second order in the errors.
inline constexpr int kMostProducts = 3;
SeparableCorrection separate(const VolumetricTable& table, std::size_t k, double enough_m);

}  // namespace mdof::algo
