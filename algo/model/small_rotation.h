// R = Rz(εz) Ry(εy) Rx(εx) and its derivatives, for the rigid model.
#pragma once

#include <Eigen/Core>
#include <array>

#include "schema/axis.h"

namespace mdof::algo {

// Sine and cosine for |x| <= 0.25 rad by their Taylor series. The error is at most 1 ulp. Unlike
// std::sin, the result is identical to the last bit for every compiler, library and processor.
struct SinCos {
  double sin, cos;
};
SinCos small_sin_cos(double x_rad);
inline constexpr double kSmallAngleMax_rad = 0.25;

struct Rotation {
  Eigen::Matrix3d R_MC;
  std::array<Eigen::Matrix3d, 3> dR_MC;  // ∂R/∂εx, ∂R/∂εy, ∂R/∂εz
};
Rotation rotation(double ex_rad, double ey_rad, double ez_rad);

// Returns the rotation for the errors of an axis in its local frame. For any moving axis, the
// rotations are applied in the order A, B, C about the machine's axes. The columns of L are the
// local axes in machine coordinates. Angles transform like vectors: e_machine = L e, and R = Lᵀ
// Rz(C) Ry(B) Rx(A) L. L only exchanges coordinates and signs, so there are no rounding errors.
Rotation local_rotation(Axis axis, const Errors5& local);
// Returns R of local_rotation() with identical bits, in a third of the time.
Eigen::Matrix3d local_rotation_matrix(Axis axis, const Errors5& local);

}  // namespace mdof::algo
