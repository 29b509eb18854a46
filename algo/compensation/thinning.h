// Reduces the points of a table for a controller that holds few points and interpolates linearly.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// The points that stay, and the largest deviation of the lines between them from an omitted point
// (largest of all columns).
struct Thinned {
  std::vector<std::size_t> kept;  // ascending; the first and the last are among them
  double largest_deviation = 0;   // in the unit of the columns
};

// Keeps the fewest points of x (strictly increasing), with unchanged values, so that linear
// interpolation deviates by at most `tolerance` at each omitted point of each column. 0: all points
// stay. The time grows with the square of the number of points. Errors: fewer than two points; x
// that does not increase; a value that is not finite (the error names its position); columns of
// different length; a tolerance that is negative or not finite.
Result<Thinned> thinned(const std::vector<double>& x,
                        const std::vector<std::vector<double>>& columns, double tolerance);

// The smallest tolerance (within 1 %) for which at most `most` points stay; `most` >= 2.
Result<double> tolerance_for(const std::vector<double>& x,
                             const std::vector<std::vector<double>>& columns, std::size_t most);

}  // namespace mdof::algo
