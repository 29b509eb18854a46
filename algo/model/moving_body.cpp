#include "algo/model/moving_body.h"

#include <Eigen/Geometry>

#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

constexpr int kMostSteps = 40;

Errors5 negative(Errors5 errors) {
  for (double& x : errors) x = -x;
  return errors;
}

Eigen::Vector3d axial(const Eigen::Matrix3d& m) {
  return {(m(2, 1) - m(1, 2)) / 2, (m(0, 2) - m(2, 0)) / 2, (m(1, 0) - m(0, 1)) / 2};
}

// The angles whose rotation is R. Each step reduces the error by about the size of the angles.
void set_angles(Axis axis, const Eigen::Matrix3d& R, Errors5& local) {
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector3d step = axial(R - local_rotation_matrix(axis, local));
    local[kEx] += step.x();
    local[kEy] += step.y();
    local[kEz] += step.z();
    if (step.cwiseAbs().maxCoeff() < 1e-17) return;
  }
}

// The errors of the inverse pose.
Errors5 inverse(Model model, Axis axis, const Errors5& local) {
  Errors5 out = negative(local);
  const Eigen::Vector3d shift(0, local[kDy], local[kDz]);
  Eigen::Vector3d turned;
  if (model == Model::rigid) {
    const Eigen::Matrix3d back = local_rotation_matrix(axis, local).transpose();
    set_angles(axis, back, out);
    turned = back * shift;
  } else {
    turned = shift - Eigen::Vector3d(local[kEx], local[kEy], local[kEz]).cross(shift);
  }
  out[kDy] = -turned.y();
  out[kDz] = -turned.z();
  return out;
}

bool differs(const AxisErrors& errors, Model model, const MovingAxis& moving) {
  return errors.valid && moving.sides.fixture_moves && model != Model::simplified;
}

}  // namespace

AxisErrors errors_of_moving_body(AxisErrors errors, Model model, const MovingAxis& moving) {
  if (differs(errors, model, moving))
    errors.local = negative(inverse(model, moving.axis, errors.local));
  return errors;
}

AxisErrors errors_of_target(AxisErrors errors, Model model, const MovingAxis& moving) {
  if (differs(errors, model, moving))
    errors.local = inverse(model, moving.axis, negative(errors.local));
  return errors;
}

}  // namespace mdof::algo
