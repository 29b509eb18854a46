// A table with fewer points: what a controller that holds few, and joins them by straight lines, is
// given.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// Which points stay, and how far the lines between them are from any point that went (largest of
// all columns).
struct Thinned {
  std::vector<std::size_t> kept;  // ascending; the first and the last are among them
  double largest_deviation = 0;   // in the unit of the columns
};

// The fewest points of x (strictly increasing), values unchanged, between which straight lines come
// within `tolerance` of every column at every point that is left out. 0: all points stay. Takes
// time with the square of the points. Errors: fewer than two points, x that does not increase, a
// value that is not finite (each named by its place), columns of another length, a tolerance that
// is none.
Result<Thinned> thinned(const std::vector<double>& x,
                        const std::vector<std::vector<double>>& columns, double tolerance);

// The smallest tolerance (within 1 %) with which `most` points are enough; `most` >= 2.
Result<double> tolerance_for(const std::vector<double>& x,
                             const std::vector<std::vector<double>>& columns, std::size_t most);

}  // namespace mdof::algo
