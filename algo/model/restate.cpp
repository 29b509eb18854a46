#include "algo/model/restate.h"

#include "algo/iso230/straightness.h"
#include "algo/model/moving_body.h"
#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

// Returns (R - I) arm for a moving target, (I - Rᵀ) arm for a moving fixture.
Eigen::Vector3d rotation_shift(Model model, const MovingAxis& moving, const Errors5& local,
                               const Eigen::Vector3d& arm) {
  if (model == Model::rigid && moving.sides.fixture_moves) {
    Errors5 of_fixture = local;
    for (double& x : of_fixture) x = -x;
    return arm - local_rotation(moving.axis, of_fixture).R_MC * arm;
  }
  if (model == Model::rigid) return local_rotation(moving.axis, local).R_MC * arm - arm;
  const double ex = local[kEx], ey = local[kEy], ez = local[kEz];
  return {ey * arm.z() - ez * arm.y(), ez * arm.x() - ex * arm.z(), ex * arm.y() - ey * arm.x()};
}

// Returns J cov Jᵀ. J is I except for ∂(δy, δz)/∂(εx, εy, εz).
Covariance5 carried(const Covariance5& covariance, const Eigen::Vector3d& arm) {
  using Matrix5 = Eigen::Matrix<double, 5, 5, Eigen::RowMajor>;
  Matrix5 J = Matrix5::Identity();
  J(kDy, kEx) = -arm.z();
  J(kDy, kEz) = arm.x();
  J(kDz, kEx) = arm.y();
  J(kDz, kEy) = -arm.x();
  const Eigen::Map<const Matrix5> before(covariance.data());
  Covariance5 after{};
  Eigen::Map<Matrix5>(after.data()) = J * before * J.transpose();
  return after;
}

}  // namespace

Eigen::Vector3d reference_point(const StatedAt& at, Axis axis, double travel_m) {
  if (at.reference == Reference::carriage) return {travel_m, 0, 0};
  const Vec3 local = to_local(axis, at.point_m);
  return {local[0], local[1], local[2]};
}

AxisErrors restate(const AxisErrors& errors, Model model, const MovingAxis& moving, double travel_m,
                   const StatedAt& from, const StatedAt& to) {
  if (!errors.valid || from == to) return errors;
  const Eigen::Vector3d arm =
      reference_point(to, moving.axis, travel_m) - reference_point(from, moving.axis, travel_m);
  const Eigen::Vector3d change = rotation_shift(model, moving, errors.local, arm);
  AxisErrors out = errors;
  out.local[kDy] += change.y();
  out.local[kDz] += change.z();
  out.covariance = carried(errors.covariance, arm);
  return out;
}

AxisErrors solved(const Solver& solver, const Point& point, const MovingAxis& moving,
                  const StatedAt& to) {
  const double travel_m = moving.sides.target_travel_m(point.position_m);
  const AxisErrors of_target = solver.solve(travel_m, point.probe_m, point.probe_u_m);
  return restate(errors_of_moving_body(of_target, solver.model(), moving), solver.model(), moving,
                 travel_m, kAtCarriage, to);
}

Model model_of(const Run& run) {
  Model model = Model::rigid;
  model_from(run.header.provenance.model, model);
  return model;
}

Run restate(Run run, const StatedAt& to) {
  if (run.header.stated == to) return run;
  const Model model = model_of(run);
  const MovingAxis moving = run.header.moving();
  for (MeasuredPoint& p : run.points) {
    const double travel_m = moving.sides.target_travel_m(p.point.position_m);
    p.errors = restate(p.errors, model, moving, travel_m, run.header.stated, to);
  }
  run.header.stated = to;
  run.straightness = straightness(moving, run.points);
  run.angles = angles(moving, run.points);
  return run;
}

}  // namespace mdof::algo
