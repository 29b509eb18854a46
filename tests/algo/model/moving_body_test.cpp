// A moving fixture with known errors. The pose of the target in the fixture is calculated by
// rotations of Eigen. The errors of the fixture must be found again.
#include "algo/model/moving_body.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "algo/model/restate.h"

namespace mdof::algo {
namespace {

Eigen::Matrix3d columns(Axis axis) {  // local axes x, y, z in machine coordinates
  Eigen::Matrix3d L = Eigen::Matrix3d::Identity();
  if (axis == Axis::y) L << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (axis == Axis::z) L << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return L;
}

Eigen::Matrix3d turned(const Eigen::Vector3d& abc) {
  return (Eigen::AngleAxisd(abc.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(abc.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(abc.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

// The angles A, B, C of Rz(C) Ry(B) Rx(A).
Eigen::Vector3d angles_of(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(-R(2, 0)), std::atan2(R(1, 0), R(0, 0))};
}

struct Moved {
  MovingAxis moving{Axis::x, {.fixture_moves = true}};
  Eigen::Matrix3d R;      // rotation of the fixture relative to the target, machine coordinates
  Eigen::Vector3d shift;  // error of the origin of M, perpendicular to the travel
  double travel_m = 0;    // of the target in M
  AxisErrors target;      // errors of the target at the origin of the carriage

  // A point m of the fixture is at R m + s x̂ + shift, where s is the travel of the fixture.
  Eigen::Vector3d error_at(const Vec3& m) const {
    const Eigen::Vector3d point(m[0], m[1], m[2]);
    return R * point + shift - point;
  }
};

Moved random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Moved m;
  m.moving.axis = static_cast<Axis>(random() % 3);
  m.travel_m = 0.06 * unit(random);
  const Eigen::Matrix3d L = columns(m.moving.axis);
  m.R = turned(1e-3 * Eigen::Vector3d(unit(random), unit(random), unit(random)));
  m.shift = L * Eigen::Vector3d(0, 1e-4 * unit(random), 1e-4 * unit(random));
  const Eigen::Vector3d s = L * Eigen::Vector3d(-m.travel_m, 0, 0);
  const Eigen::Vector3d t = L.transpose() * (-m.R.transpose() * (s + m.shift));
  const Eigen::Vector3d angles = L.transpose() * angles_of(m.R.transpose());
  m.target.valid = true;
  m.target.local = {t.y(), t.z(), angles.x(), angles.y(), angles.z()};
  return m;
}

TEST(MovingBody, FixtureHasItsOwnErrorsAtEachPoint) {
  std::mt19937_64 random(7);
  double first_order_m = 0;
  for (int i = 0; i < 300; ++i) {
    const Moved m = random_motion(random);
    const Eigen::Matrix3d L = columns(m.moving.axis);
    const AxisErrors moving = errors_of_moving_body(m.target, Model::rigid, m.moving);
    for (const StatedAt& to : {kAtFixture, StatedAt{Reference::tool, {0.03, -0.05, 0.08}}}) {
      const auto stated = [&](const AxisErrors& errors, const MovingAxis& axis) {
        return restate(errors, Model::rigid, axis, m.travel_m, kAtCarriage, to).local;
      };
      const Errors5 found = stated(moving, m.moving);
      const Eigen::Vector3d error = L.transpose() * m.error_at(to.point_m);
      EXPECT_NEAR(-found[kDy], error.y(), 2e-10);
      EXPECT_NEAR(-found[kDz], error.z(), 2e-10);
      const Eigen::Vector3d angles = L.transpose() * angles_of(m.R);
      EXPECT_NEAR(-found[kEx], angles.x(), 1e-15);
      EXPECT_NEAR(-found[kEy], angles.y(), 1e-15);
      EXPECT_NEAR(-found[kEz], angles.z(), 1e-15);
      const Errors5 of_target = stated(m.target, {m.moving.axis, {}});
      first_order_m = std::max(first_order_m, std::abs(of_target[kDy] + error.y()));
    }
    // The component of the shift along the motion (below 0.3 µm) is left out, times 1 mrad.
    const AxisErrors back = errors_of_target(moving, Model::rigid, m.moving);
    for (std::size_t k = 0; k < kErrorCount; ++k)
      EXPECT_NEAR(back.local[k], m.target.local[k], 4e-10);
  }
  EXPECT_GT(first_order_m, 90e-9) << "the terms of second order are large enough for this test";
}

// The inverse of I + [ε] is I - [ε] to second order, so that -(δ - ε x δ) remains.
TEST(MovingBody, ExactModelTurnsTheShiftAndKeepsTheAngles) {
  AxisErrors target;
  target.valid = true;
  target.local = {1e-4, 0, 1e-3, 2e-3, 3e-3};
  const MovingAxis fixture{Axis::x, {.fixture_moves = true}};
  const Errors5 found = errors_of_moving_body(target, Model::exact, fixture).local;
  EXPECT_NEAR(found[kDy], 1e-4, 1e-18);
  EXPECT_NEAR(found[kDz], -1e-3 * 1e-4, 1e-18);  // z of ε x δ is εx δy
  EXPECT_EQ(found[kEx], 1e-3);
  EXPECT_EQ(errors_of_moving_body(target, Model::simplified, fixture).local, target.local);
  for (const Model model : {Model::simplified, Model::exact, Model::rigid})
    EXPECT_EQ(errors_of_moving_body(target, model, {Axis::x, {}}).local, target.local);
}

// Large angles: the rotation of the fixture is the inverse of that of the target, to rounding.
TEST(MovingBody, LargeAnglesAreThoseOfTheInverseRotation) {
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const Eigen::Matrix3d L = columns(axis);
    for (const Eigen::Vector3d& abc :
         {Eigen::Vector3d(0.2, -0.15, 0.1), Eigen::Vector3d(-0.1, 0.2, 0.15)}) {
      AxisErrors target;
      target.valid = true;
      const Eigen::Vector3d of_target = L.transpose() * abc;
      target.local = {0, 0, of_target.x(), of_target.y(), of_target.z()};
      const MovingAxis fixture{axis, {.fixture_moves = true}};
      const Errors5 found = errors_of_moving_body(target, Model::rigid, fixture).local;
      const Eigen::Vector3d expected = L.transpose() * angles_of(turned(abc).transpose());
      EXPECT_NEAR(-found[kEx], expected.x(), 1e-15);
      EXPECT_NEAR(-found[kEy], expected.y(), 1e-15);
      EXPECT_NEAR(-found[kEz], expected.z(), 1e-15);
    }
  }
}

}  // namespace
}  // namespace mdof::algo
