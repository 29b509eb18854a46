// Names for the shapes of a series that no reading determines.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/separation/separation.h"

namespace mdof::algo {

// `unseen`: orthonormal columns, one row a place. Tried by name: offset, slope, parabola, and the
// periods `periods_m`; what is left is named by its symmetry about the middle, or by where it is.
std::vector<UnseenShape> named_shapes(const std::vector<double>& places_m,
                                      const Eigen::MatrixXd& unseen,
                                      const std::vector<double>& periods_m);

// Periods that may be hidden where what comes back after each of these ways is: s, s/2, s/3 ... of
// their greatest common divisor s, down to two steps.
std::vector<double> hidden_periods(const std::vector<double>& ways_m, double step_m,
                                   double match_m);

}  // namespace mdof::algo
