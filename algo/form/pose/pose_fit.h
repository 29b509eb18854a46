// Finds the pose of B relative to A by the Gauss-Newton method (README.md, "Surfaces and
// registration"). The caller gives the first pose and the directions in which the pose may change.
// All poses are about the middle of A.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "algo/form/pose/places.h"
#include "algo/form/registration.h"
#include "algo/form/surface.h"

namespace mdof::algo {

// Residuals B - A at each place of A for one pose; NaN where B is not measured.
struct PoseFit {
  MapPose pose;
  std::vector<double> left_m, slope_x, slope_y;  // residual without the plane, and slopes of B
  std::array<double, 3> plane{};                 // piston, tilt x, tilt y (times size)
  // Huber's limit: a larger residual enters with its absolute value instead of its square.
  double limit_m = std::numeric_limits<double>::infinity();
  double count = 0;  // number of places where B is measured
};

PoseFit plane_fit_at_pose(const Places& a, const Surface& b, const MapPose& pose);

// Columns of `directions`: orthonormal directions in the coordinates (shift x, shift y, turn times
// size). `most`: largest number of iterations.
PoseFit fitted_from(const Places& a, const Surface& b, const MapPose& start,
                    const Eigen::MatrixXd& directions, double pixel_m, int most);

// size_m: mean absolute residual over the places where `counts` is true and B is measured; a larger
// residual than `most_m` enters as `most_m`. share: these places divided by all places.
struct MeanLeft {
  double size_m = 0, share = 0;
};
MeanLeft mean_left(const PoseFit& fit, const std::vector<bool>& counts, double most_m);

// Mean square of the residuals after removal of their least-squares plane, over the places where B
// is measured. Negative: B is measured at less than `least_share` of the places. A fast measure to
// compare the first poses of a search.
double mean_square_at(const Places& a, const Surface& b, const MapPose& pose, double least_share);

}  // namespace mdof::algo
