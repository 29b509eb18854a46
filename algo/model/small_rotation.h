// R = Rz(εz) Ry(εy) Rx(εx) and its derivatives, for the rigid model.
#pragma once

#include <Eigen/Core>
#include <array>

#include "schema/axis.h"

namespace mdof::algo {

// Sine and cosine for |x| <= 0.25 rad by their Taylor series in plain arithmetic. The error is at
// most 1 ulp, and every compiler, library and processor gives the same bits, unlike std::sin.
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

// The same for the errors of an axis in its local frame. The rotations follow one another about the
// machine's axes, A first, for any moving axis. If L has the local axes in machine coordinates,
// angles transform like vectors: e_machine = L e, and R = Lᵀ Rz(C) Ry(B) Rx(A) L. L only exchanges
// coordinates and signs, so nothing is rounded.
Rotation local_rotation(Axis axis, const Errors5& local);
// Only R, with the same bits, in a third of the time.
Eigen::Matrix3d local_rotation_matrix(Axis axis, const Errors5& local);

}  // namespace mdof::algo
