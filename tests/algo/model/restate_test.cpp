// Errors at another reference point are compared with a pose that is calculated by rotations of
// Eigen.
#include "algo/model/restate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

struct Case {
  Axis axis;
  double travel_m;
  Errors5 local;
};

Case random_case(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Case c{static_cast<Axis>(random() % 3), 0.1 * unit(random), {}};
  for (std::size_t k = 0; k < 5; ++k) c.local[k] = (k < 2 ? 50e-6 : 1e-3) * unit(random);
  return c;
}

Eigen::Matrix3d local_frame(Axis axis) {
  Eigen::Matrix3d L;  // its columns are the local axes x, y, z in machine coordinates
  if (axis == Axis::x) L = Eigen::Matrix3d::Identity();
  if (axis == Axis::y) L << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (axis == Axis::z) L << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return L;
}

// Error e(P) of the point P of a rigid carriage in the local frame: Rz(C) Ry(B) Rx(A) about the
// axes of the machine.
Eigen::Vector3d error_at(const Case& c, const Eigen::Vector3d& P_machine) {
  const Eigen::Matrix3d L = local_frame(c.axis);
  const Eigen::Vector3d angles = L * Eigen::Vector3d(c.local[kEx], c.local[kEy], c.local[kEz]);
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  const Eigen::Vector3d t = L * Eigen::Vector3d(c.travel_m, c.local[kDy], c.local[kDz]);
  const Eigen::Vector3d nominal = P_machine - L * Eigen::Vector3d(c.travel_m, 0, 0);
  return L.transpose() * (R * nominal + t - P_machine);
}

AxisErrors solved(const Case& c) {
  AxisErrors errors;
  errors.valid = true;
  errors.local = c.local;
  return errors;
}

TEST(Restate, IsTheErrorOfTheBodyAtThePoint) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 500; ++i) {
    const Case c = random_case(random);
    const Vec3 P = {0.05 * unit(random), 0.05 * unit(random), 0.05 * unit(random)};
    for (const StatedAt& to : {kAtFixture, StatedAt{Reference::tool, P}}) {
      const AxisErrors at =
          restate(solved(c), Model::rigid, {c.axis, {}}, c.travel_m, kAtCarriage, to);
      const Eigen::Vector3d expected = error_at(c, {to.point_m[0], to.point_m[1], to.point_m[2]});
      EXPECT_NEAR(at.local[kDy], expected.y(), 1e-15);
      EXPECT_NEAR(at.local[kDz], expected.z(), 1e-15);
      for (const int k : {kEx, kEy, kEz})
        EXPECT_EQ(at.local[static_cast<std::size_t>(k)], c.local[static_cast<std::size_t>(k)]);
    }
  }
}

TEST(Restate, SmallAngleModelsAreLinearAtTheFixture) {
  const Case c{Axis::x, 0.06, {1e-6, 2e-6, 3e-4, 4e-4, 5e-4}};
  for (const Model model : {Model::simplified, Model::exact}) {
    const AxisErrors at =
        restate(solved(c), model, {c.axis, {}}, c.travel_m, kAtCarriage, kAtFixture);
    EXPECT_NEAR(at.local[kDy], 1e-6 - 0.06 * 5e-4, 1e-18);
    EXPECT_NEAR(at.local[kDz], 2e-6 + 0.06 * 4e-4, 1e-18);
  }
}

TEST(Restate, ThereAndBackGivesTheSameErrors) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const Case c = random_case(random);
    const StatedAt tool{Reference::tool, {0.01, -0.02, 0.07}};
    const AxisErrors there =
        restate(solved(c), Model::rigid, {c.axis, {}}, c.travel_m, kAtCarriage, tool);
    const AxisErrors back =
        restate(there, Model::rigid, {c.axis, {}}, c.travel_m, tool, kAtCarriage);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(back.local[k], c.local[k], 1e-17);
  }
}

TEST(Restate, CovarianceMatchesTheScatterOfDraws) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const Case c{Axis::y, 0.04, {1e-6, -2e-6, 30e-6, -40e-6, 50e-6}};
  const Errors5 sd = {20e-9, 30e-9, 1e-6, 2e-6, 3e-6};
  AxisErrors errors = solved(c);
  for (std::size_t k = 0; k < 5; ++k) errors.covariance[6 * k] = sd[k] * sd[k];
  const StatedAt tool{Reference::tool, {0.01, -0.02, 0.03}};
  const AxisErrors at = restate(errors, Model::rigid, {c.axis, {}}, c.travel_m, kAtCarriage, tool);
  constexpr int kDraws = 40000;
  Errors5 sum{}, square{};
  double product = 0;
  for (int i = 0; i < kDraws; ++i) {
    AxisErrors drawn = errors;
    for (std::size_t k = 0; k < 5; ++k) drawn.local[k] += sd[k] * normal(random);
    drawn = restate(drawn, Model::rigid, {c.axis, {}}, c.travel_m, kAtCarriage, tool);
    for (std::size_t k = 0; k < 5; ++k) {
      const double off = drawn.local[k] - at.local[k];
      sum[k] += off;
      square[k] += off * off;
    }
    product += (drawn.local[kDy] - at.local[kDy]) * (drawn.local[kEz] - at.local[kEz]);
  }
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(std::sqrt(square[k] / kDraws) / std::sqrt(at.covariance[6 * k]), 1, 0.02);
  EXPECT_NEAR(product / kDraws / at.covariance[5 * kDy + kEz], 1, 0.05);
}

TEST(Restate, LeavesUnsolvedErrorsUnsolved) {
  const AxisErrors nothing;
  EXPECT_FALSE(restate(nothing, Model::rigid, {Axis::x, {}}, 0.1, kAtCarriage, kAtFixture).valid);
}

TEST(SmallRotation, RotationMatrixHasTheBitsOfLocalRotation) {
  for (const Axis axis : {Axis::x, Axis::y, Axis::z})
    for (int i = -20; i <= 20; ++i) {
      const Errors5 errors = {0, 0, 0.011 * i, -0.007 * i + 0.01, 0.0123 * i - 0.002};
      EXPECT_EQ(local_rotation_matrix(axis, errors), local_rotation(axis, errors).R_MC);
    }
}

}  // namespace
}  // namespace mdof::algo
