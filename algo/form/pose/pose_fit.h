// Finds the pose of B relative to A by the Gauss-Newton method, from a start and in given
// directions (README.md, "Surfaces and registration"). Poses are about the middle of A.
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

// Residuals of B relative to A at each place; NaN where B is not measured.
struct PoseFit {
  MapPose pose;
  std::vector<double> left_m, slope_x, slope_y;  // left_m: without the plane
  std::array<double, 3> plane{};                 // piston, tilt x, tilt y (times size)
  // A larger residual counts with its absolute value instead of its square.
  double limit_m = std::numeric_limits<double>::infinity();
  double count = 0;  // places where B is measured
};

PoseFit fit_at(const Places& a, const Surface& b, const MapPose& pose);

// Columns of `directions`: shift x, shift y, turn times size, orthonormal. `most`: largest number
// of steps.
PoseFit fitted_from(const Places& a, const Surface& b, const MapPose& start,
                    const Eigen::MatrixXd& directions, double pixel_m, int most);

// Mean size of the residuals over the places where `counts` is true and B is measured; a residual
// above `most_m` counts as `most_m`. `share`: share of these places.
struct MeanLeft {
  double size_m = 0, share = 0;
};
MeanLeft mean_left(const PoseFit& fit, const std::vector<bool>& counts, double most_m);

// Mean square of the residuals of B without their best plane, over the places where B is measured.
// Negative: B is measured at less than `least_share` of the places. Fast, to compare starts.
double mean_square_at(const Places& a, const Surface& b, const MapPose& pose, double least_share);

}  // namespace mdof::algo
