// A rigid displacement moves a point x to R x + p.
#pragma once

#include <Eigen/Core>

#include "algo/machine/tiny_angle.h"
#include "schema/axis.h"

namespace mdof::algo {

struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  // m

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return R * x + p; }
  Pose operator*(const Pose& inner) const { return {R * inner.R, R * inner.p + p}; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

Eigen::Vector3d vector_of(const Vec3& v);

// Rz(c) Ry(b) Rx(a), for the angle errors of a body; |angles| <= 0.1 rad.
Eigen::Matrix3d tiny_rotation(double a_rad, double b_rad, double c_rad);
// Rotation by any angle about the axis `direction`: 0 is X, 1 is Y, 2 is Z.
Eigen::Matrix3d turn_about(std::size_t direction, double angle_rad);
// The angles a, b, c of R = Rz(c) Ry(b) Rx(a), exact to rounding if they are below 0.1 rad.
Eigen::Vector3d small_angles_of(const Eigen::Matrix3d& R);

}  // namespace mdof::algo
