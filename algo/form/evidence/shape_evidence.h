// Decides whether the shape of two maps, and not their noise, determines their relative pose.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/form/pose/places.h"
#include "algo/form/registration.h"
#include "algo/form/surface.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

class ShapeEvidence {
 public:
  // Poses are about the middle of `about`, the places of A.
  ShapeEvidence(const SurfaceMap& a, const Places& about);

  // The directions that the shape determines at this pose, one in each column (shift x, shift y,
  // turn times size), orthonormal. They are orthogonal to the directions in which the slopes of the
  // two maps have nothing in common (README.md, "Surfaces and registration").
  Eigen::MatrixXd determined(const Surface& b, const MapPose& about_middle) const;
  // Whether A alone has slopes that a tilt does not explain.
  bool has_shape() const;

 private:
  struct Place {
    double x_m, y_m, slope_x, slope_y;
  };
  double x_mid_m_, y_mid_m_, size_m_;
  std::vector<Place> places_;
};

}  // namespace mdof::algo
