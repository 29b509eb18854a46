// Rigid displacements: x' = R x + p.
#pragma once

#include <Eigen/Core>

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

// Sine and cosine for |x| <= 0.1 rad, within 1 ulp, of additions and products alone: the same bits
// everywhere, and several at a time. V: double, or several of them.
template <class V>
inline V tiny_sin(V x) {
  const V z = x * x;
  return x + x * (z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880)))));
}
template <class V>
inline V tiny_cos(V x) {
  const V z = x * x;
  return 1.0 +
         z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800)))));
}

// Rz(c) Ry(b) Rx(a) of the errors of a body, |angles| <= 0.1 rad.
Eigen::Matrix3d tiny_rotation(double a_rad, double b_rad, double c_rad);
// A turn of any size about X, Y, Z (0, 1, 2).
Eigen::Matrix3d turn_about(std::size_t direction, double angle_rad);
// The angles a, b, c of R = Rz(c) Ry(b) Rx(a) for small ones, to first order of which they are R's
// axial vector; exact to rounding below 0.1 rad.
Eigen::Vector3d small_angles_of(const Eigen::Matrix3d& R);

}  // namespace mdof::algo
