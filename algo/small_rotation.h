// R = Rz(εz) Ry(εy) Rx(εx) and its derivatives, for the rigid model (DESIGN §3).
#pragma once

#include <Eigen/Core>
#include <array>

namespace mdof::algo {

// Sine and cosine for |x| <= 0.25 rad by their Taylor series in plain arithmetic: within 1 ulp
// there, and the same bits from every compiler, library and processor, which std::sin is not.
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

}  // namespace mdof::algo
