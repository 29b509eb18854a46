// Names of the shapes of a series that no reading determines.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/separation/separation.h"

namespace mdof::algo {

// `unseen`: orthonormal columns, one row for each place. The names are tried in this order: offset,
// slope, parabola, the periods `periods_m`. The name of the rest is its symmetry about the middle,
// or its range of places.
std::vector<UndeterminedShape> named_shapes(const std::vector<double>& places_m,
                                            const Eigen::MatrixXd& unseen,
                                            const std::vector<double>& periods_m);

// Periods that may be hidden if a shape repeats after each of these distances: s, s/2, s/3 ... down
// to two steps, with their greatest common divisor s.
std::vector<double> hidden_periods(const std::vector<double>& ways_m, double step_m,
                                   double match_m);

}  // namespace mdof::algo
