// Surfaces that determine none, one or all of the movements are compared with copies of themselves.
// The copies have features of real parts added: noise, a bow, a spike, a raised edge, the mark of a
// clamp. The difference must be the added feature; a movement that hides the feature is a wrong
// result. If the shape determines a known movement, the movement must be found.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "algo/form/map_figures.h"
#include "algo/form/registration.h"
#include "tests/algo/form/known_maps.h"

namespace mdof::algo::registration_matrix {
namespace {

using Shape = std::function<double(double, double)>;
constexpr double kPixel_m = 0.66e-3, kX0_m = -26e-3, kY0_m = -16e-3;
constexpr std::size_t kNx = 80, kNy = 50;

SurfaceMap map_on_grid(const Shape& z) {
  return map_of(z, kX0_m, kY0_m, kPixel_m, kNx, kNy);
}
double flat(double, double) {
  return 0;
}
double sphere(double x, double y) {
  return (x * x + y * y) / 40;
}
double cylinder(double x, double) {
  return x * x / 40;
}
double tilted(double x, double y) {
  return 1.7e-4 * x - 3e-5 * y;
}
double freeform(double x, double y) {
  return 0.8e-6 * std::sin(2 * std::numbers::pi * x / 23e-3) *
             std::cos(2 * std::numbers::pi * y / 17e-3) +
         4e-4 * x * y + 0.3e-6 * std::sin((x + 2 * y) / 4e-3) + 0.05e-6 * std::cos(x / 1.7e-3 + 1);
}
double bow(double x, double y) {
  return 2e-6 * (x / 26e-3) * (x / 26e-3) + 0.1e-6 * std::cos(y / 9e-3);
}

struct NamedShape {
  const char* name;
  Shape z;
  std::size_t undetermined;
};
const std::vector<NamedShape>& shapes() {
  static const std::vector<NamedShape> all = {{"flat", flat, 3},
                                              {"sphere", sphere, 3},
                                              {"cylinder", cylinder, 2},
                                              {"tilted", tilted, 3},
                                              {"freeform", freeform, 0}};
  return all;
}

// PV and RMS of the difference without its plane, calculated by separate normal equations.
struct Left {
  double pv_m = 0, rms_m = 0;
};
Left without_plane(const SurfaceMap& a, const SurfaceMap& b) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(a.z_m.size()), 3);
  Eigen::VectorXd z(A.rows());
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    A.row(row) << 1, a.x_m(k % a.nx) * 1e2, a.y_m(k / a.nx) * 1e2;
    z(row) = b.z_m[k] - a.z_m[k];
  }
  const Eigen::VectorXd left = z - A * (A.transpose() * A).ldlt().solve(A.transpose() * z);
  return {left.maxCoeff() - left.minCoeff(),
          std::sqrt(left.squaredNorm() / static_cast<double>(left.size()))};
}

SurfaceMap with_noise(SurfaceMap map, unsigned seed, double sd_m) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, 1);
  for (double& z : map.z_m) z += sd_m * normal(engine);
  return map;
}

struct Tolerance {
  double shift_m = 5e-9, turn_rad = 1e-7, share = 1e-5;
};
Comparison expect_no_movement(const SurfaceMap& a, const SurfaceMap& b, const std::string& what,
                              const Tolerance& tolerance = {}) {
  const auto found = compare(a, b, Register::rigid);
  EXPECT_TRUE(found) << what;
  const Left truth = without_plane(a, b);
  EXPECT_NEAR(found->pose.shift_x_m, 0, tolerance.shift_m) << what;
  EXPECT_NEAR(found->pose.shift_y_m, 0, tolerance.shift_m) << what;
  EXPECT_NEAR(found->pose.turn_rad, 0, tolerance.turn_rad) << what;
  EXPECT_NEAR(found->pv_m, truth.pv_m, tolerance.share * truth.pv_m + 1e-15) << what;
  EXPECT_NEAR(found->rms_m, truth.rms_m, tolerance.share * truth.rms_m + 1e-15) << what;
  EXPECT_EQ(found->pixels, a.z_m.size()) << what;
  return *found;
}

TEST(RegistrationMatrix, IdenticalMapsDoNotMove) {
  for (const auto& [name, z, undetermined] : shapes()) {
    const SurfaceMap a = map_on_grid(z);
    EXPECT_EQ(expect_no_movement(a, a, name).undetermined, undetermined) << name;
    // Piston and tilt, and heights that are rounded to six digits of um as in a file.
    SurfaceMap b = a, rounded = a;
    for (std::size_t k = 0; k < b.z_m.size(); ++k) {
      rounded.z_m[k] = std::nearbyint(a.z_m[k] * 1e12) * 1e-12;
      b.z_m[k] += 3e-6 + 1e-5 * a.x_m(k % a.nx);
      b.z_m[k] = std::nearbyint(b.z_m[k] * 1e12) * 1e-12;
    }
    expect_no_movement(rounded, b, std::string(name) + ", rounded", {1e-7, 1e-6, 0.05});
  }
}

TEST(RegistrationMatrix, SpikeAtTheBorderRemains) {
  for (const auto& [name, z, undetermined] : shapes())
    for (const double spike_m : {5e-6, -0.4e-6, 1e3})
      for (const std::size_t pixel : {std::size_t{20}, std::size_t{0}, 31 * kNx, kNx * kNy - 7}) {
        const SurfaceMap a = map_on_grid(z);
        SurfaceMap b = a;
        b.z_m[pixel] += spike_m;
        const std::string what = std::string(name) + " " + std::to_string(pixel);
        expect_no_movement(a, b, what);
        expect_no_movement(b, a, what + " reversed");
      }
}

TEST(RegistrationMatrix, ARaisedEdgeAndTheMarkOfAClampAreLeft) {
  for (const auto& [name, z, undetermined] : shapes()) {
    const SurfaceMap a = map_on_grid(z);
    SurfaceMap column = a, row = a, mark = a;
    for (std::size_t j = 0; j < kNy; ++j) column.z_m[j * kNx] += 1e-6;
    for (std::size_t i = 0; i < kNx; ++i) row.z_m[(kNy - 1) * kNx + i] -= 1e-6;
    for (std::size_t j = 20; j < 30; ++j)
      for (std::size_t i = 0; i < 2; ++i) mark.z_m[j * kNx + i] += 3e-6;
    for (const SurfaceMap* b : {&column, &row, &mark}) {
      expect_no_movement(a, *b, name);
      expect_no_movement(*b, a, std::string(name) + " reversed");
    }
    EXPECT_GT(compare(a, mark, Register::rigid)->pv_m, 2.9e-6) << name;
  }
}

TEST(RegistrationMatrix, NoiseMovesByNoMoreThanItsU) {
  for (const auto& [name, z, undetermined] : shapes())
    for (const double sd_m : {1e-9, 50e-9}) {
      const SurfaceMap a = with_noise(map_on_grid(z), 1, sd_m),
                       b = with_noise(map_on_grid(z), 2, sd_m);
      // With slopes of 1e-4 in 4000 pixels, u of a shift is about sd sqrt(2) / (1e-4 sqrt(4000)).
      // The limit includes a factor 2: interpolated heights have less noise, which attracts the
      // fit.
      const bool is_fully_undetermined = undetermined == 3;
      const double shift_m = is_fully_undetermined ? 1e-12 : 12 * sd_m * 1.42 / (1e-4 * 63);
      const auto found = compare(a, b, Register::rigid);
      const Left truth = without_plane(a, b);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->undetermined, undetermined) << name << " " << sd_m;
      EXPECT_NEAR(found->pose.shift_x_m, 0, shift_m) << name << " " << sd_m;
      EXPECT_NEAR(found->pose.shift_y_m, 0, shift_m) << name << " " << sd_m;
      EXPECT_NEAR(found->pose.turn_rad, 0, shift_m / 10e-3) << name << " " << sd_m;
      EXPECT_NEAR(found->rms_m, truth.rms_m, (is_fully_undetermined ? 1e-6 : 0.03) * truth.rms_m)
          << name;
      EXPECT_NEAR(found->pv_m, truth.pv_m, (is_fully_undetermined ? 1e-6 : 0.2) * truth.pv_m)
          << name;
      // The first map is exact, as nominal heights are. An exact cylinder still determines a turn.
      if (is_fully_undetermined)
        expect_no_movement(map_on_grid(z), b, std::string(name) + " against noise");
      if (is_fully_undetermined)
        expect_no_movement(b, map_on_grid(z), std::string(name) + " noise against exact");
    }
}

TEST(RegistrationMatrix, ABowIsLeftWhereTheShapeDeterminesNoMovement) {
  for (const auto& [name, z, undetermined] : shapes()) {
    if (undetermined == 0) continue;
    for (const double sd_m : {0.0, 20e-9}) {
      const SurfaceMap a = with_noise(map_on_grid(z), 3, sd_m);
      const SurfaceMap b = with_noise(
          map_on_grid([&, &z = z](double x, double y) { return z(x, y) + bow(x, y); }), 4, sd_m);
      const Tolerance tolerance = undetermined == 3 ? Tolerance{} : Tolerance{1e-7, 1e-3, 0.01};
      expect_no_movement(a, b, std::string(name) + " + bow", tolerance);
      if (sd_m == 0) expect_no_movement(b, a, std::string(name) + " + bow, reversed", tolerance);
    }
  }
}

// All movements are determined, so a movement can remove a part of the bow. Linear least squares
// with analytic slopes gives the expected part.
TEST(RegistrationMatrix, BowMovesAFreeformAsLeastSquaresPredict) {
  const double share = 0.02;
  const auto b_of = [&](double x, double y) { return freeform(x, y) + share * bow(x, y); };
  const SurfaceMap a = map_on_grid(freeform), b = map_on_grid(b_of);
  Eigen::MatrixXd A(static_cast<Eigen::Index>(a.z_m.size()), 6);
  Eigen::VectorXd z(A.rows());
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    const double x = a.x_m(k % a.nx), y = a.y_m(k / a.nx), h = 1e-6;
    const double sx = (b_of(x + h, y) - b_of(x - h, y)) / (2 * h),
                 sy = (b_of(x, y + h) - b_of(x, y - h)) / (2 * h);
    A.row(static_cast<Eigen::Index>(k)) << 1e-6, x * 1e-4, y * 1e-4, sx * 1e-3, sy * 1e-3,
        (sy * x - sx * y) * 1e-1;
    z(static_cast<Eigen::Index>(k)) = a.z_m[k] - b.z_m[k];
  }
  const Eigen::VectorXd by_hand = A.colPivHouseholderQr().solve(z);
  const auto found = compare(a, b, Register::rigid);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pose.shift_x_m, by_hand(3) * 1e-3, 10e-6);
  EXPECT_NEAR(found->pose.shift_y_m, by_hand(4) * 1e-3, 10e-6);
  EXPECT_NEAR(found->pose.turn_rad, by_hand(5) * 1e-1, 1e-3);
  const Left at_rest = without_plane(a, b);
  EXPECT_LT(found->rms_m, at_rest.rms_m);
  EXPECT_GT(found->rms_m, 0.8 * at_rest.rms_m);
}

SurfaceMap moved(const Shape& z, double sx_m, double sy_m, double turn_deg) {
  const double c = std::cos(turn_deg * kDeg), s = std::sin(turn_deg * kDeg);
  return map_of(
      [=, &z](double x, double y) {
        const double u = x - sx_m, v = y - sy_m;
        return z(c * u + s * v, -s * u + c * v) + 5e-6 + 1e-5 * x - 2e-5 * y;
      },
      kX0_m - 2e-3, kY0_m - 2e-3, kPixel_m, kNx + 6, kNy + 6);
}

TEST(RegistrationMatrix, FindsKnownMovementsThatAreDetermined) {
  const SurfaceMap a = map_on_grid(freeform);
  const auto found = compare(a, moved(freeform, 0.41e-3, -0.77e-3, 1.3), Register::rigid);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->undetermined, 0u);
  EXPECT_NEAR(found->pose.shift_x_m, 0.41e-3, 4e-9);
  EXPECT_NEAR(found->pose.shift_y_m, -0.77e-3, 4e-9);
  EXPECT_NEAR(found->pose.turn_rad / kDeg, 1.3, 1e-4);
  EXPECT_LT(found->rms_m, 1e-9);
  // A plane and a sphere are the same everywhere, so no difference remains for any position of B.
  for (const Shape& z : {Shape(flat), Shape(sphere), Shape(tilted)}) {
    const auto same = compare(a.z_m.empty() ? a : map_on_grid(z), moved(z, 0.41e-3, -0.77e-3, 1.3),
                              Register::rigid);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->undetermined, 3u);
    EXPECT_EQ(same->pose.shift_x_m, 0);
    EXPECT_EQ(same->pose.shift_y_m, 0);
    EXPECT_EQ(same->pose.turn_rad, 0);
    EXPECT_LT(same->pv_m, 1e-11);
  }
  for (const double turn_deg : {1.3, -8.0}) {
    const auto turned =
        compare(map_on_grid(cylinder), moved(cylinder, 0, 0, turn_deg), Register::rigid);
    ASSERT_TRUE(turned);
    EXPECT_EQ(turned->undetermined, 2u);
    EXPECT_NEAR(turned->pose.turn_rad / kDeg, turn_deg, 1e-4);
    EXPECT_LT(turned->pv_m, 1e-10);
  }
}

// A known movement and the mark of a clamp. The mark must not change the movement found.
TEST(RegistrationMatrix, MarkDoesNotDisturbAKnownMovement) {
  const SurfaceMap a = map_on_grid(freeform);
  SurfaceMap b = moved(freeform, 0.41e-3, -0.77e-3, 1.3);
  for (std::size_t j = 20; j < 30; ++j)
    for (std::size_t i = 6; i < 9; ++i) b.z_m[j * b.nx + i] += 3e-6;
  const auto found = compare(a, b, Register::rigid);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pose.shift_x_m, 0.41e-3, 0.5e-6);
  EXPECT_NEAR(found->pose.shift_y_m, -0.77e-3, 0.5e-6);
  EXPECT_NEAR(found->pose.turn_rad / kDeg, 1.3, 1e-3);
  EXPECT_NEAR(found->pv_m, 3e-6, 0.7e-6);
}

TEST(RegistrationMatrix, UnrelatedShapesDoNotMove) {
  const auto h = [](double x, double y) {
    const double u = (x - 6e-3) * (x - 6e-3) + (y - 9e-3) * (y - 9e-3);
    return 1e-6 * (std::sin(x / 5e-3) + 0.7 * std::cos(y / 3e-3) + 0.02e6 * x * y / 3 +
                   0.5 * std::exp(-u / 20e-6));
  };
  const SurfaceMap a = map_on_grid(h);
  expect_no_movement(a, map_on_grid([&](double x, double y) { return -h(x, y); }), "upside down");
  expect_no_movement(a, with_noise(map_on_grid(flat), 5, 1e-6), "noise");
  const auto waves = [](double x, double y) {
    return 0.4e-6 * std::sin(x / 10e-3 + 1) + 0.3e-6 * std::cos(y / 7e-3);
  };
  expect_no_movement(map_on_grid(flat), map_on_grid(waves), "flat and long waves");
  expect_no_movement(map_on_grid(waves), map_on_grid(flat), "long waves and flat");
}

// A nominal cylinder is compared with a part that has an error along the axis of the cylinder.
TEST(RegistrationMatrix, ErrorAlongTheAxisOfACylinderRemains) {
  const auto part = [](double x, double y) { return cylinder(x, y) + 0.3e-6 * std::sin(y / 5e-3); };
  expect_no_movement(map_on_grid(cylinder), map_on_grid(part), "cylinder", {1e-6, 1e-3, 1e-3});
}

TEST(RegistrationMatrix, ProfilesMoveAlongXOnly) {
  const auto z = [](double x, double) {
    return 1e-6 * (std::sin(x / 1e-3) + 0.3 * std::sin(3.1 * x / 1e-3 + 1));
  };
  const auto line = [](const Shape& of) { return map_of(of, 0, 0, 0.1e-3, 200, 1); };
  const SurfaceMap a = line(z);
  EXPECT_EQ(expect_no_movement(a, a, "profile").undetermined, 2u);
  expect_no_movement(line(tilted), line(tilted), "line");
  const auto found = compare(a, line([&](double x, double) { return z(x - 0.3e-3, 0) + 2e-4 * x; }),
                             Register::rigid);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pose.shift_x_m, 0.3e-3, 1e-7);
  EXPECT_EQ(found->pose.shift_y_m, 0);
  EXPECT_EQ(found->pose.turn_rad, 0);
}

}  // namespace
}  // namespace mdof::algo::registration_matrix
