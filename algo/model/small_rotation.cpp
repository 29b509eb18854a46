#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

Eigen::Matrix3d columns_of(const std::array<std::array<double, 3>, 3>& axes) {
  Eigen::Matrix3d L;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      L(i, j) = axes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return L;
}

}  // namespace

SinCos small_sin_cos(double x) {
  // Horner form of x - x³/3! + x⁵/5! ...; the terms left out are below 2^-53 of the result.
  const double z = x * x;
  const double s =
      x * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156))))));
  const double c =
      1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * (1 - z / 132)))));
  return {s, c};
}

Rotation rotation(double ex, double ey, double ez) {
  const auto [sx, cx] = small_sin_cos(ex);
  const auto [sy, cy] = small_sin_cos(ey);
  const auto [sz, cz] = small_sin_cos(ez);
  Eigen::Matrix3d Rx, Ry, Rz, dRx, dRy, dRz;
  Rx << 1, 0, 0, 0, cx, -sx, 0, sx, cx;
  Ry << cy, 0, sy, 0, 1, 0, -sy, 0, cy;
  Rz << cz, -sz, 0, sz, cz, 0, 0, 0, 1;
  dRx << 0, 0, 0, 0, -sx, -cx, 0, cx, -sx;
  dRy << -sy, 0, cy, 0, 0, 0, -cy, 0, -sy;
  dRz << -sz, -cz, 0, cz, -sz, 0, 0, 0, 0;
  const Eigen::Matrix3d RzRy = Rz * Ry;
  Rotation r;
  r.R_MC = RzRy * Rx;
  r.dR_MC[0] = RzRy * dRx;
  r.dR_MC[1] = Rz * dRy * Rx;
  r.dR_MC[2] = dRz * Ry * Rx;
  return r;
}

Rotation local_rotation(Axis axis, const Errors5& local) {
  const Eigen::Matrix3d L = columns_of(local_axes(axis));
  const Eigen::Vector3d e = L * Eigen::Vector3d(local[kEx], local[kEy], local[kEz]);
  const Rotation machine = rotation(e.x(), e.y(), e.z());
  Rotation r;
  r.R_MC = L.transpose() * machine.R_MC * L;
  for (std::size_t j = 0; j < 3; ++j) {
    const Eigen::Vector3d about = L.col(static_cast<Eigen::Index>(j));
    r.dR_MC[j] = L.transpose() *
                 (about.x() * machine.dR_MC[0] + about.y() * machine.dR_MC[1] +
                  about.z() * machine.dR_MC[2]) *
                 L;
  }
  return r;
}

Eigen::Matrix3d local_rotation_alone(Axis axis, const Errors5& local) {
  const Eigen::Matrix3d L = columns_of(local_axes(axis));
  const Eigen::Vector3d e = L * Eigen::Vector3d(local[kEx], local[kEy], local[kEz]);
  const auto [sx, cx] = small_sin_cos(e.x());
  const auto [sy, cy] = small_sin_cos(e.y());
  const auto [sz, cz] = small_sin_cos(e.z());
  Eigen::Matrix3d Rx, Ry, Rz;
  Rx << 1, 0, 0, 0, cx, -sx, 0, sx, cx;
  Ry << cy, 0, sy, 0, 1, 0, -sy, 0, cy;
  Rz << cz, -sz, 0, sz, cz, 0, 0, 0, 1;
  const Eigen::Matrix3d RzRy = Rz * Ry;
  const Eigen::Matrix3d R = RzRy * Rx;
  return L.transpose() * R * L;
}

}  // namespace mdof::algo
