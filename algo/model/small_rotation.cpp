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

// The rotation about each axis of the machine.
struct Turns {
  Turns(const SinCos& a, const SinCos& b, const SinCos& c) {
    Rx << 1, 0, 0, 0, a.cos, -a.sin, 0, a.sin, a.cos;
    Ry << b.cos, 0, b.sin, 0, 1, 0, -b.sin, 0, b.cos;
    Rz << c.cos, -c.sin, 0, c.sin, c.cos, 0, 0, 0, 1;
    RzRy = Rz * Ry;
  }
  Eigen::Matrix3d Rx, Ry, Rz, RzRy;
};

}  // namespace

SinCos small_sin_cos(double x) {
  // Horner form of x - x³/3! + x⁵/5! ...; the omitted terms are below 2^-53 of the result.
  const double z = x * x;
  const double s =
      x * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156))))));
  const double c =
      1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * (1 - z / 132)))));
  return {s, c};
}

Rotation rotation(double ex, double ey, double ez) {
  const SinCos x = small_sin_cos(ex), y = small_sin_cos(ey), z = small_sin_cos(ez);
  const Turns by(x, y, z);
  Eigen::Matrix3d dRx, dRy, dRz;
  dRx << 0, 0, 0, 0, -x.sin, -x.cos, 0, x.cos, -x.sin;
  dRy << -y.sin, 0, y.cos, 0, 0, 0, -y.cos, 0, -y.sin;
  dRz << -z.sin, -z.cos, 0, z.cos, -z.sin, 0, 0, 0, 0;
  Rotation r;
  r.R_MC = by.RzRy * by.Rx;
  r.dR_MC[0] = by.RzRy * dRx;
  r.dR_MC[1] = by.Rz * dRy * by.Rx;
  r.dR_MC[2] = dRz * by.Ry * by.Rx;
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

Eigen::Matrix3d local_rotation_matrix(Axis axis, const Errors5& local) {
  const Eigen::Matrix3d L = columns_of(local_axes(axis));
  const Eigen::Vector3d e = L * Eigen::Vector3d(local[kEx], local[kEy], local[kEz]);
  const Turns by(small_sin_cos(e.x()), small_sin_cos(e.y()), small_sin_cos(e.z()));
  const Eigen::Matrix3d R = by.RzRy * by.Rx;
  return L.transpose() * R * L;
}

}  // namespace mdof::algo
