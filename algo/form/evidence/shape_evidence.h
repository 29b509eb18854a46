// Finds the directions of movement in which the shape of two maps, and not only their noise,
// determines their relative pose.
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
  // `about`: the selected pixels of A (pose/places.h). All poses rotate about the middle of A.
  ShapeEvidence(const SurfaceMap& a, const Places& about);

  // The directions of movement that the shape determines at this pose: orthonormal columns in the
  // coordinates (shift x, shift y, turn times size). They are orthogonal to the directions in which
  // the slopes of the two maps are not correlated (README.md, "Surfaces and registration").
  Eigen::MatrixXd determined(const Surface& b, const MapPose& about_middle) const;
  // True: the slopes of A determine at least one direction, although piston and tilt are fitted,
  // too.
  bool has_shape() const;

 private:
  struct Place {
    double x_m, y_m, slope_x, slope_y;
  };
  double x_mid_m_, y_mid_m_, size_m_;
  std::vector<Place> places_;
};

}  // namespace mdof::algo
