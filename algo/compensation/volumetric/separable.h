// Approximates a correction over a grid of X, Y and Z by a sum of functions of one command and of
// products of functions of two commands, for controllers whose tables have one axis each.
#pragma once

#include <array>
#include <vector>

#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// first(command of axis `first`) * second(command of axis `second`), by node of each axis. Both
// factors have the same size, in √m.
struct AxisProduct {
  std::size_t first = 0, second = 1;
  std::vector<double> of_first, of_second;
};

struct SeparableCorrection {
  std::array<std::vector<double>, 3> along;  // functions of X, Y, Z, by node, m; empty: no function
  std::vector<AxisProduct> products;
  double left_m = 0;  // largest residual at a node
};

// Correction of axis k. Takes means over the other axes, then products for each pair of axes until
// less than `enough_m` of the pair's joint effect remains, at most kMostProducts for each pair. The
// joint effect of three axes remains: it is of second order in the errors of a machine with linear
// axes.
inline constexpr int kMostProducts = 3;
SeparableCorrection separate(const VolumetricTable& table, std::size_t k, double enough_m);

}  // namespace mdof::algo
