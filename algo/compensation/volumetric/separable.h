// A correction over a grid of X, Y and Z as a sum of functions of one command and of products of
// two of them: what controllers hold that know one axis a table.
#pragma once

#include <array>
#include <vector>

#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// first(command of axis `first`) * second(command of axis `second`); both factors are of one size,
// √m, by node of their axis.
struct AxisProduct {
  std::size_t first = 0, second = 1;
  std::vector<double> of_first, of_second;
};

struct SeparableCorrection {
  std::array<std::vector<double>, 3> along;  // of X, Y, Z, by node, m; empty: nothing
  std::vector<AxisProduct> products;
  double left_m = 0;  // the largest at a node that the sum does not hold
};

// Of the command of axis k. Means over the other axes, then products of each pair of axes until
// less than `enough_m` is left of what the pair does together, at most kMostProducts a pair. What
// three axes do together is left: second order in the errors of a machine of linear axes.
inline constexpr int kMostProducts = 3;
SeparableCorrection separate(const VolumetricTable& table, std::size_t k, double enough_m);

}  // namespace mdof::algo
