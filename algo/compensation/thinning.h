// Reduces the number of points of a table, for a controller that accepts few points and
// interpolates linearly.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

// The points that are kept, and the error of linear interpolation between them.
struct Thinned {
  std::vector<std::size_t> kept;  // ascending; the first and the last are among them
  double largest_deviation = 0;   // at the omitted points of all columns, in the columns' unit
};

// Finds the smallest set of points for which linear interpolation deviates by at most `tolerance`
// from each omitted point of each column. The values do not change. Tolerance 0: all points are
// kept. x is strictly increasing. The calculation time grows with the square of the number of
// points. Errors: fewer than two points; x that does not increase; a value that is not finite (the
// error states its position); columns of different length; a tolerance that is negative or not
// finite.
Result<Thinned> thinned(const std::vector<double>& x,
                        const std::vector<std::vector<double>>& columns, double tolerance);

// Returns the smallest tolerance (within 1 %) for which at most `most` points are kept; `most` >=
// 2.
Result<double> tolerance_for(const std::vector<double>& x,
                             const std::vector<std::vector<double>>& columns, std::size_t most);

}  // namespace mdof::algo
