// Rotations are compared with rotations of a vector about one axis after the other, by sine and
// cosine of the standard library.
#include "algo/machine/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace mdof::algo {
namespace {

// Rotates v about axis k, counter-clockwise if seen from the positive end of the axis.
Eigen::Vector3d turned(Eigen::Vector3d v, int k, double angle_rad) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  const double x = c * v[i] - s * v[j];
  v[j] = s * v[i] + c * v[j];
  v[i] = x;
  return v;
}

constexpr double kAngles[][3] = {{0.08, -0.06, 0.09}, {-0.1, 0.1, 0.05}, {0.03, 0.1, -0.1},
                                 {1e-6, 0, 0},        {0, 2e-6, 0},      {0, 0, -3e-6}};

TEST(Pose, TinyRotationIsAboutXThenYThenZ) {
  for (const auto& [a, b, c] : kAngles)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d expected = turned(turned(turned(v, 0, a), 1, b), 2, c);
      EXPECT_LT((tiny_rotation(a, b, c) * v - expected).norm(), 1e-15) << a << " " << k;
    }
}

TEST(Pose, RotationOfAnySizeIsCounterClockwise) {
  for (int direction = 0; direction < 3; ++direction)
    for (const double angle : {-3.0, -1.0, 1e-3, 0.7, 2.0, 5.5})
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d v = Eigen::Vector3d::Unit(k);
        const Eigen::Matrix3d R = turn_about(static_cast<std::size_t>(direction), angle);
        EXPECT_LT((R * v - turned(v, direction, angle)).norm(), 1e-15) << direction << " " << angle;
      }
}

TEST(Pose, RecoversSmallAngles) {
  for (const auto& [a, b, c] : kAngles) {
    const Eigen::Vector3d found = small_angles_of(tiny_rotation(a, b, c));
    EXPECT_LT((found - Eigen::Vector3d(a, b, c)).norm(), 1e-15) << a;
  }
}

TEST(Pose, ProductAndInverseTransformPoints) {
  const Pose outer{turn_about(2, 0.7), {1, 2, 3}}, inner{turn_about(0, -1.2), {-4, 5, 6}};
  const Eigen::Vector3d x(0.5, -0.25, 2);
  const Eigen::Vector3d there = turned(turned(x, 0, -1.2) + inner.p, 2, 0.7) + outer.p;
  EXPECT_LT((outer * inner * x - there).norm(), 1e-14);
  EXPECT_LT((outer * (inner * x) - there).norm(), 1e-14);
  EXPECT_LT(((outer * inner).inverse() * there - x).norm(), 1e-14);
  EXPECT_LT((Pose() * x - x).norm(), 1e-300);
}

}  // namespace
}  // namespace mdof::algo
