// Describes the shapes of a series that the readings do not determine.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/separation/separation.h"

namespace mdof::algo {

// `unseen`: the undetermined shapes as orthonormal columns, one row for each place. Names are given
// in this order: offset, slope, parabola, the periods `periods_m`. The remaining shapes are
// described together, by their symmetry about the middle or by their range of places.
std::vector<UndeterminedShape> named_shapes(const std::vector<double>& places_m,
                                            const Eigen::MatrixXd& unseen,
                                            const std::vector<double>& periods_m);

// Periods of shapes that repeat after each of the distances `ways_m`: s, s/2, s/3 ... down to two
// steps. s is the greatest common divisor of the distances.
std::vector<double> hidden_periods(const std::vector<double>& ways_m, double step_m,
                                   double match_m);

}  // namespace mdof::algo
