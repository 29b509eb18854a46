#include "algo/iso230/square_tilt.h"

#include "algo/iso230/line_fit.h"
#include "algo/iso230/target_means.h"
#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

// The run with the straightness in the frame of the square, Rᵀ (d x̂ + δ).
Run in_square(const Run& measured) {
  Run run = restate(measured, kAtCarriage);
  const MovingAxis moving = run.header.moving();
  for (MeasuredPoint& p : run.points) {
    if (!p.errors.valid) continue;
    const Errors5 of_target = errors_of_target(p.errors, Model::rigid, moving).local;
    const Eigen::Vector3d place(moving.sides.target_travel_m(p.point.position_m), of_target[kDy],
                                of_target[kDz]);
    const Eigen::Vector3d turned =
        local_rotation_matrix(moving.axis, of_target).transpose() * place;
    p.errors.local[kDy] = turned.y();
    p.errors.local[kDz] = turned.z();
  }
  return run;
}

double named_slope(const Run& run, std::size_t named) {
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  return least_squares_line(own_travels(run.header.sides, series), column(series, named)).slope;
}

struct MeasuredDirection {
  double across = 0;  // component along the other axis, minus the slope of the straightness
  double third = 0;   // component along the third axis
};

MeasuredDirection measured_direction(const Run& run, Axis other, Axis third) {
  const Axis axis = run.header.axis;
  const Run fixed = restate(run, kAtFixture);
  if (model_of(run) != Model::rigid)
    return {0, named_slope(fixed, straightness_along(axis, third))};
  const Run square = in_square(run);
  const std::size_t across = straightness_along(axis, other);
  return {named_slope(square, across) - named_slope(fixed, across),
          named_slope(square, straightness_along(axis, third))};
}

}  // namespace

double square_tilt_rad(const Run& run_a, const Run& run_b, AxisPair axes) {
  const auto third = static_cast<Axis>(3 - static_cast<int>(axes.a) - static_cast<int>(axes.b));
  const MeasuredDirection a = measured_direction(run_a, axes.b, third),
                          b = measured_direction(run_b, axes.a, third);
  return -squareness_sign(axes) * (a.across + b.across + a.third * b.third);
}

}  // namespace mdof::algo
