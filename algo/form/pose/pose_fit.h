// How B lies against A by Gauss and Newton, from a start and in given directions (README.md,
// "Surfaces and registration"). Poses are about the middle of A.
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

// What B leaves against A at each place: NaN where B is not measured.
struct PoseFit {
  MapPose pose;
  std::vector<double> left_m, slope_x, slope_y;  // left_m: without the plane
  std::array<double, 3> plane{};                 // piston, tilt x, tilt y (times size)
  // A place that leaves more counts by its size, not by its square.
  double limit_m = std::numeric_limits<double>::infinity();
  double count = 0;  // places where B is measured
};

PoseFit fit_at(const Places& a, const Surface& b, const MapPose& pose);

// Columns of `directions`: shift x, shift y, turn times size, orthonormal. `most`: steps.
PoseFit fitted_from(const Places& a, const Surface& b, const MapPose& start,
                    const Eigen::MatrixXd& directions, double pixel_m, int most);

// Mean size of what a pose leaves over the places where `counts` and B is measured, none of them
// above `most_m`, and the share of such places.
struct MeanLeft {
  double size_m = 0, share = 0;
};
MeanLeft mean_left(const PoseFit& fit, const std::vector<bool>& counts, double most_m);

// Mean square of what B leaves without its best plane, over the places where it is measured;
// negative: it is measured at less than `least_share` of them. For starts, and fast.
double mean_square_at(const Places& a, const Surface& b, const MapPose& pose, double least_share);

}  // namespace mdof::algo
