// Two straight axes with known directions and a square that is clamped tilted. The poses and the
// readings of the square follow from rotations of Eigen; the angle of the two directions is the
// expected squareness.
#include "algo/iso230/square_tilt.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "algo/iso230/squareness.h"
#include "algo/iso230/squareness_lines.h"
#include "algo/model/moving_body.h"
#include "algo/model/restate.h"

namespace mdof::algo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d turned(double a, double b, double c) {
  return (Eigen::AngleAxisd(c, Vector3d::UnitZ()) * Eigen::AngleAxisd(b, Vector3d::UnitY()) *
          Eigen::AngleAxisd(a, Vector3d::UnitX()))
      .toRotationMatrix();
}

Vector3d local_of(Axis axis, const Vector3d& v) {
  const auto local = to_local(axis, {v.x(), v.y(), v.z()});
  return {local[0], local[1], local[2]};
}

struct Clamped {
  Axis axis;
  Sides sides;
  Model model;
  Vector3d direction;  // of the axis in M, unit vector
  Matrix3d R;          // rotation of the square in M
  Vector3d abc;        // its angles

  // Errors of the target after the travel d, at the fixture, with the sign of the target.
  AxisErrors errors(double d) const {
    const auto along = static_cast<int>(axis);
    const Vector3d moved = d / direction[along] * direction;
    AxisErrors e;
    e.valid = true;
    Vector3d shift;
    if (model == Model::rigid) {
      shift = moved;
      shift[along] = 0;
    } else {
      // A face with the normal n moves by (moved · n) / n_k along the probe of the direction k.
      for (int k = 0; k < 3; ++k) shift[k] = k == along ? 0 : moved.dot(R.col(k)) / R(k, k);
    }
    const Vector3d angles = local_of(axis, abc), local = local_of(axis, shift);
    e.local = {local.y(), local.z(), angles.x(), angles.y(), angles.z()};
    if (model != Model::rigid) return e;
    const MovingAxis moving{axis, sides};
    return restate(errors_of_moving_body(e, model, moving), model, moving, d, kAtCarriage,
                   kAtFixture);
  }

  mdof::Run run() const {
    mdof::Run run;
    run.header.id = static_cast<int>(axis) + 1;
    run.header.axis = axis;
    run.header.sides = sides;
    run.header.state = RunState::complete;
    run.header.provenance.model = to_string(model);
    for (const int approach : {1, -1})
      for (int i = 0; i < 5; ++i) {
        MeasuredPoint p;
        p.target = i + 1;
        p.run = 1;
        p.point.direction = approach;
        p.point.position_m = p.target_m = 0.01 * (i + 1);
        p.errors = errors(sides.target_travel_m(p.target_m));
        run.points.push_back(p);
      }
    return run;
  }
};

TEST(SquareTilt, ATiltedSquareDoesNotChangeTheSquareness) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst_without_rad = 0;
  for (int i = 0; i < 400; ++i) {
    const int a = i % 2, b = i % 3 == 0 ? 1 + (a == 1) : 2;
    const auto direction = [&](int along) {
      Vector3d u = 5e-4 * Vector3d(unit(random), unit(random), unit(random));
      u[along] = 1;
      return Vector3d(u.normalized());
    };
    const Vector3d u_a = direction(a), u_b = direction(b);
    // The fixture may be mounted anew for the second axis, so the angle in the plane may differ.
    const Vector3d abc = 2e-3 * Vector3d(unit(random), unit(random), unit(random));
    const Model model = i % 4 < 2 ? Model::rigid : i % 4 == 2 ? Model::exact : Model::simplified;
    const auto sides = [&] { return Sides{random() % 2 == 0, random() % 2 == 0}; };
    const Matrix3d R = turned(abc.x(), abc.y(), abc.z());
    const auto one = Clamped{static_cast<Axis>(a), sides(), model, u_a, R, abc}.run();
    const auto other = Clamped{static_cast<Axis>(b), sides(), model, u_b, R, abc}.run();
    const Squareness s = squareness(one, other, {}).value();
    const double angle_rad = std::acos(u_a.dot(u_b)) - std::acos(0.0);
    const double expected_rad = squareness_sign(s.axes) * angle_rad;
    EXPECT_NEAR(s.error_rad, expected_rad, 2e-8) << i;  // third order: 2 mrad cubed
    worst_without_rad =
        std::max(worst_without_rad, std::abs(s.error_rad - s.tilt_rad() - expected_rad));
    const SquarenessByLine lines = squareness_lines(one, other, s).value();
    EXPECT_NEAR(lines.end_point.error_rad, s.error_rad, 1e-12);
    EXPECT_NEAR(lines.minimum_zone.error_rad, s.error_rad, 1e-12);
  }
  EXPECT_GT(worst_without_rad, 2e-6);
}

TEST(SquareTilt, AParallelSquareHasNoEffect) {
  for (const Model model : {Model::rigid, Model::exact, Model::simplified}) {
    const auto x =
        Clamped{Axis::x, {}, model, Vector3d::UnitX(), Matrix3d::Identity(), Vector3d::Zero()}
            .run();
    const auto y =
        Clamped{Axis::y, {}, model, Vector3d::UnitY(), Matrix3d::Identity(), Vector3d::Zero()}
            .run();
    EXPECT_EQ(square_tilt_rad(x, y, {Axis::x, Axis::y}), 0);
  }
}

}  // namespace
}  // namespace mdof::algo
