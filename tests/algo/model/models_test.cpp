#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "algo/model/rigid.h"
#include "algo/model/small_angle/small_angle.h"
#include "algo/model/small_rotation.h"
#include "algo/model/solver.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// Random errors as large as in the paper's simulations: angles of ±1 mrad, displacements of ±50 µm,
// travel d from 0 to 60 mm.
struct Draw {
  explicit Draw(unsigned seed, double angle_rad = 1e-3) : rng(seed), angle(angle_rad) {}
  double uniform(double half) { return std::uniform_real_distribution<>(-half, half)(rng); }
  Errors5 errors() {
    return {uniform(50e-6), uniform(50e-6), uniform(angle), uniform(angle), uniform(angle)};
  }
  double travel() { return std::uniform_real_distribution<>(0, 0.06)(rng); }
  std::mt19937_64 rng;
  double angle;
};

SmallAngleFixture small(const Rig& rig) {
  return make_small_angle_fixture(make_fixture(rig).value()).value();
}

// The definition in the paper. The point P1 on the line of the probe belongs to P0 = T⁻¹ P1 on the
// target. P0 must be on the plane of the target.
double output_by_inverse(const Errors5& e, double d, double x, double y_or_z, bool top, double h) {
  Eigen::Matrix4d T;
  T << 1, -e[kEz], e[kEy], d, e[kEz], 1, -e[kEx], e[kDy], -e[kEy], e[kEx], 1, e[kDz], 0, 0, 0, 1;
  const Eigen::Matrix4d inverse = T.inverse();
  // P1 = base + s * along. The coordinate of P0 across the plane is linear in s and must equal its
  // nominal value.
  const Eigen::Vector4d base =
      top ? Eigen::Vector4d(x, y_or_z, 0, 1) : Eigen::Vector4d(x, 0, y_or_z, 1);
  const Eigen::Vector4d along = top ? Eigen::Vector4d(0, 0, 1, 0) : Eigen::Vector4d(0, 1, 0, 0);
  const int row = top ? 2 : 1;
  const double goal = top ? 0 : h;
  const double s = (goal - (inverse * base)(row)) / (inverse * along)(row);
  return top ? s : s - h;
}

TEST(ExactModel, OutputsMatchTheInverseTransform) {
  const auto f = small(test::rig_x());
  Draw draw(1);
  for (int i = 0; i < 1000; ++i) {
    const Errors5 e = draw.errors();
    const double d = draw.travel();
    const auto m = exact_outputs(f, d, e);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(m[k], output_by_inverse(e, d, f.x[k], f.across[k], k < 3, f.h), 1e-16);
    }
  }
}

TEST(ExactModel, RecoversRandomErrorsToRounding) {
  for (const auto& rig : {test::rig_x(), test::rig_x(7.3, -12, 31), test::rig_x(25, 0, 5)}) {
    const auto f = small(rig);
    Draw draw(2);
    for (int i = 0; i < 20000; ++i) {
      const Errors5 e = draw.errors();
      const double d = draw.travel();
      const Errors5 got = solve_small_angle(Model::exact, f, d, exact_outputs(f, d, e));
      for (std::size_t k = 0; k < 5; ++k) ASSERT_NEAR(got[k], e[k], k < 2 ? 1e-15 : 1e-14) << k;
    }
  }
}

TEST(ExactModel, HoldsForLargeAngles) {
  const auto f = small(test::rig_x());
  Draw draw(3, 0.05);
  for (int i = 0; i < 20000; ++i) {
    const Errors5 e = draw.errors();
    const double d = draw.travel();
    const Errors5 got = solve_small_angle(Model::exact, f, d, exact_outputs(f, d, e));
    for (std::size_t k = 0; k < 5; ++k) ASSERT_NEAR(got[k], e[k], 1e-12) << k;
  }
}

// Omitted terms by algo/README.md: ε̂x = εx - p εz, ε̂y = εy + q εz, ε̂z = (εz - εx εy)/(1 + εy²),
// and similar for δ̂.
TEST(SimplifiedModel, DiffersFromTruthByTheOmittedTerms) {
  const auto f = small(test::rig_x());
  Draw draw(4);
  double worst_angle = 0, worst_length = 0;
  for (int i = 0; i < 20000; ++i) {
    const Errors5 e = draw.errors();
    const double d = draw.travel(), z_D = 0.02;
    const Errors5 got = solve_small_angle(Model::simplified, f, d, exact_outputs(f, d, e));
    const double q = (e[kEx] - e[kEy] * e[kEz]) / (1 + e[kEz] * e[kEz]);
    const double p = (e[kEy] + e[kEx] * e[kEz]) / (1 + e[kEz] * e[kEz]);
    const double t = 1 + e[kEy] * e[kEy];
    const double r = (e[kEz] - e[kEx] * e[kEy]) / t, u = (e[kEx] + e[kEy] * e[kEz]) / t;
    ASSERT_NEAR(got[kEx] - e[kEx], -p * e[kEz], 1e-15);
    ASSERT_NEAR(got[kEy] - e[kEy], q * e[kEz], 1e-15);
    ASSERT_NEAR(got[kEz] - e[kEz], r - e[kEz], 1e-15);
    ASSERT_NEAR(got[kDz] - e[kDz], -q * e[kDy], 1e-16);
    ASSERT_NEAR(got[kDy] - e[kDy],
                u * e[kDz] + (q - u) * z_D + f.h * (e[kEx] * e[kEx] + e[kEz] * e[kEz]) / t, 1e-16);
    worst_angle = std::max({worst_angle, std::abs(got[kEx] - e[kEx]), std::abs(got[kEz] - e[kEz])});
    worst_length = std::max(worst_length, std::abs(got[kDy] - e[kDy]));
  }
  EXPECT_LT(worst_angle, 1.01e-6);
  EXPECT_LT(worst_length, 0.11e-6);
  EXPECT_GT(worst_angle, 0.9e-6);  // the omitted terms must not be 0
}

TEST(SmallAngle, BatchGivesTheBitsOfSingleSolutions) {
  const auto f = small(test::rig_x());
  Draw draw(5);
  for (const std::size_t n : {1u, 7u, 8u, 9u, 63u, 1000u}) {
    std::vector<double> travel(n), m[5], out[5];
    BatchIn in{travel.data(), {}};
    BatchOut to{};
    for (std::size_t k = 0; k < 5; ++k) {
      m[k].resize(n);
      out[k].resize(n);
      in.reading_m[k] = m[k].data();
      to.local[k] = out[k].data();
    }
    for (std::size_t i = 0; i < n; ++i) {
      travel[i] = draw.travel();
      const auto reading = exact_outputs(f, travel[i], draw.errors());
      for (std::size_t k = 0; k < 5; ++k) m[k][i] = reading[k];
    }
    for (const Model model : {Model::simplified, Model::exact}) {
      solve_batch(model, f, in, to, n);
      for (std::size_t i = 0; i < n; ++i) {
        const Errors5 one =
            solve_small_angle(model, f, travel[i], {m[0][i], m[1][i], m[2][i], m[3][i], m[4][i]});
        for (std::size_t k = 0; k < 5; ++k) {
          ASSERT_EQ(std::bit_cast<std::uint64_t>(one[k]), std::bit_cast<std::uint64_t>(out[k][i]))
              << n << " " << i;
        }
      }
    }
  }
}

TEST(SmallAngle, ProbeOrderAndDirectionComeFromTheRig) {
  Rig rig = test::rig_x();
  std::swap(rig.probes[0], rig.probes[4]);
  std::swap(rig.probes[1], rig.probes[3]);
  for (auto& probe : rig.probes) {
    for (auto& component : probe.direction) component = -component;
  }
  const Solver solver = Solver::create(rig, Model::exact).value();
  const Errors5 e{3e-6, -2e-6, 1e-4, 2e-4, -3e-4};
  const auto m = exact_outputs(*solver.small_angle(), 0.03, e);
  std::vector<double> readings(5);
  for (std::size_t k = 0; k < 5; ++k) readings[solver.small_angle()->probe[k]] = m[k];
  // The probe measures in the opposite direction, so the sign of its reading is reversed.
  EXPECT_LT(m[0] * exact_outputs(small(test::rig_x()), 0.03, e)[0], 0);
  const AxisErrors got = solver.solve(0.03, readings, {});
  ASSERT_TRUE(got.valid);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(got.local[k], e[k], 1e-14);
}

TEST(SmallRotation, SineAndCosineAreWithinOneUlp) {
  for (double x = -kSmallAngleMax_rad; x <= kSmallAngleMax_rad; x += 1.7e-4) {
    const auto [s, c] = small_sin_cos(x);
    EXPECT_NEAR(s, std::sin(x), 6e-17);
    EXPECT_NEAR(c, std::cos(x), 1.2e-16);
  }
}

TEST(RigidModel, JacobianMatchesDifferences) {
  for (const Rig& rig : {test::rig_x(), test::rig_oblique()}) {
    const Fixture fixture = make_fixture(rig).value();
    const Errors5 e{2e-5, -3e-5, 0.02, -0.01, 0.03};
    const auto J = rigid_jacobian(fixture, 0.04, e);
    for (std::size_t k = 0; k < 5; ++k) {
      const double step = 1e-6;
      Errors5 up = e, down = e;
      up[k] += step;
      down[k] -= step;
      const Eigen::VectorXd slope =
          (rigid_readings(fixture, 0.04, up) - rigid_readings(fixture, 0.04, down)) / (2 * step);
      for (Eigen::Index i = 0; i < slope.size(); ++i) {
        EXPECT_NEAR(J(i, static_cast<Eigen::Index>(k)), slope(i), 1e-9) << i << " " << k;
      }
    }
  }
}

TEST(RigidModel, RecoversRandomErrorsOnAnyFixture) {
  for (const Rig& rig : {test::rig_x(), test::rig_oblique()}) {
    const Solver solver = Solver::create(rig, Model::rigid).value();
    Draw draw(6, 5e-3);
    for (int i = 0; i < 2000; ++i) {
      const Errors5 e = draw.errors();
      const double d = draw.travel();
      const Eigen::VectorXd m = rigid_readings(solver.fixture(), d, e);
      const AxisErrors got = solver.solve(d, {m.data(), m.data() + m.size()}, {});
      ASSERT_TRUE(got.valid) << got.reason;
      for (std::size_t k = 0; k < 5; ++k) ASSERT_NEAR(got.local[k], e[k], 1e-13) << k;
      ASSERT_LT(got.residual_m, 1e-15);
    }
  }
}

TEST(RigidModel, CorrectsReadingsForKnownFlatness) {
  Rig rig = test::rig_x();
  TargetPlane top;
  top.normal = {0, 0, 1};
  top.flatness = {{-0.07, 0.0, 0.02}, {-0.02, 0.02}, {0, 1e-6, 2e-6, 1e-6, -1e-6, 3e-6}};
  TargetPlane side;
  side.normal = {0, 1, 0};
  rig.planes = {top, side};
  const Solver with_map = Solver::create(rig, Model::rigid).value();
  const Errors5 e{3e-6, 4e-6, 2e-4, 1e-4, -2e-4};
  const Eigen::VectorXd m = rigid_readings(with_map.fixture(), 0.03, e);
  const AxisErrors got = with_map.solve(0.03, {m.data(), m.data() + 5}, {});
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(got.local[k], e[k], 1e-13);
  const Solver flat = Solver::create(test::rig_x(), Model::rigid).value();
  EXPECT_GT(std::abs(flat.solve(0.03, {m.data(), m.data() + 5}, {}).local[kDz] - e[kDz]), 1e-7);
}

// A height map in the wrong unit is steeper than any surface. If the iteration does not converge,
// the point is not solved.
TEST(RigidModel, ReadingsWithoutASolutionAreNotSolved) {
  Rig rig = test::rig_x();
  TargetPlane top;
  top.normal = {0, 0, 1};
  TargetPlane side;
  side.normal = {0, 1, 0};
  // The map has teeth with a height of 0.9 mm every 1.4 mm. The yaw moves the teeth relative to D
  // and E.
  for (int i = -80; i <= 80; ++i) {
    side.flatness.first_m.push_back(0.7e-3 * i);
    const double height_m = i % 2 == 0 ? 0 : 0.9e-3;
    side.flatness.height_m.insert(side.flatness.height_m.end(), {height_m, height_m});
  }
  side.flatness.second_m = {-0.05, 0.05};
  rig.planes = {top, side};
  const Solver solver = Solver::create(rig, Model::rigid).value();
  int unsolved = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> readings_m = {0, 0, 0, 1e-4, 1e-4 + 3e-6 * i};
    const double travel_m = 0.001 + 0.0001 * i;
    const AxisErrors got = solver.solve(travel_m, readings_m, {});
    unsolved += !got.valid;
    if (!got.valid) continue;
    const Eigen::VectorXd back = rigid_readings(solver.fixture(), travel_m, got.local);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(back(static_cast<Eigen::Index>(k)), readings_m[k], 1e-9) << i;
  }
  EXPECT_GT(unsolved, 0);
  EXPECT_LT(unsolved, 100);
}

TEST(RigidModel, ReportsTheResidualOfRedundantProbes) {
  const Solver solver = Solver::create(test::rig_oblique(), Model::rigid).value();
  Eigen::VectorXd m = rigid_readings(solver.fixture(), 0.01, Errors5{});
  m(2) += 1e-6;
  EXPECT_GT(solver.solve(0.01, {m.data(), m.data() + m.size()}, {}).residual_m, 1e-7);
}

TEST(RigidModel, RefusesImpossibleAngles) {
  const Solver solver = Solver::create(test::rig_x(), Model::rigid).value();
  const AxisErrors got = solver.solve(0, {0.02, 0.05, -0.05, 0, 0}, {});
  EXPECT_FALSE(got.valid);
  EXPECT_NE(got.reason.find("rad"), std::string::npos);
}

TEST(RigidModel, RefusesEachAngleAboveQuarterRadian) {
  const Solver solver = Solver::create(test::rig_x(), Model::rigid).value();
  for (const std::size_t k : {kEx, kEy, kEz}) {
    for (const double angle : {-0.26, -0.24, 0.24, 0.26}) {
      Errors5 e{};
      e[k] = angle;
      const Eigen::VectorXd model = rigid_readings(solver.fixture(), 0.02, e);
      const AxisErrors got = solver.solve(0.02, {model.begin(), model.end()}, {});
      EXPECT_EQ(got.valid, std::abs(angle) < 0.25) << k << " " << angle;
      EXPECT_EQ(got.reason.find("rotation above 0.25 rad") != std::string::npos, !got.valid);
    }
  }
}

// The standard deviation of 20,000 solutions of noisy readings is compared with the stated
// covariance.
TEST(Covariance, MatchesTheScatterOfNoisySolutions) {
  for (const Rig& rig : {test::rig_x(), test::rig_oblique()}) {
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const std::size_t n = rig.probes.size();
    std::vector<double> u(n);
    for (std::size_t i = 0; i < n; ++i) u[i] = (10 + 5 * static_cast<double>(i)) * 1e-9;
    const double d = 0.045;
    const Eigen::VectorXd clean = rigid_readings(solver.fixture(), d, Errors5{});
    std::mt19937_64 rng(7);
    std::normal_distribution<> gauss;
    Errors5 sum2{};
    double cross = 0;
    Covariance5 stated{};
    const int trials = 20000;
    for (int t = 0; t < trials; ++t) {
      std::vector<double> m(n);
      for (std::size_t i = 0; i < n; ++i)
        m[i] = clean(static_cast<Eigen::Index>(i)) + u[i] * gauss(rng);
      const AxisErrors got = solver.solve(d, m, u);
      for (std::size_t k = 0; k < 5; ++k) sum2[k] += got.local[k] * got.local[k];
      cross += got.local[kDz] * got.local[kEy];
      stated = got.covariance;
    }
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(std::sqrt(sum2[k] / trials) / std::sqrt(stated[6 * k]), 1, 0.025) << k;
    }
    const double expected = stated[5 * kDz + kEy];
    EXPECT_NEAR(cross / trials / expected, 1, 0.05);  // correlated at a large travel
  }
}

}  // namespace
}  // namespace mdof::algo
