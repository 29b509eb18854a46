#include "algo/model/rigid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// A sixth probe is at the position of A and reads 1 µm more than A. With the weights 4 and 1, the
// residual of A is 1/5 µm, the residual of the sixth probe 4/5 µm, and the rms √((1 + 16)/25/6) µm.
// A seventh probe is not used.
TEST(RigidModel, ResidualIsTheRmsOfTheProbesInUse) {
  Fixture fixture = make_fixture(test::rig_x()).value();
  for (const std::size_t k : {0, 3}) fixture.probes.push_back(fixture.probes[k]);
  const Errors5 errors{20e-6, -30e-6, 1e-4, -2e-4, 3e-4};
  const Eigen::VectorXd exact = rigid_readings(fixture, 7e-3, errors);
  std::vector<double> readings(exact.data(), exact.data() + exact.size());
  readings[5] += 1e-6;
  readings[6] = std::nan("");
  const AxisErrors found = solve_rigid(fixture, 7e-3, readings, {4, 2, 3, 5, 6, 1, 0});
  ASSERT_TRUE(found.valid) << found.reason;
  EXPECT_TRUE(found.reason.empty());
  EXPECT_NEAR(found.residual_m, std::sqrt(17.0 / 150) * 1e-6, 1e-11);
  // The fit at A is 1/5 µm above the reading of A. At the probes without a redundant probe the fit
  // equals the reading.
  const Eigen::VectorXd fitted = rigid_readings(fixture, 7e-3, found.local);
  EXPECT_NEAR(fitted(0) - exact(0), 0.2e-6, 1e-11);
  for (const Eigen::Index k : {1, 2, 3, 4}) EXPECT_NEAR(fitted(k), exact(k), 1e-11) << k;
}

// The readings are those of the linear model for three large angles, so that the first step of the
// solution finds these angles and no displacement. The terms of second order (30 µm) require more
// steps.
TEST(RigidModel, ConvergesIfOnlyTheAnglesChange) {
  const Fixture fixture = make_fixture(test::rig_x()).value();
  const Errors5 linear{0, 0, 0.05, -0.04, 0.06};
  Eigen::VectorXd e(5);
  for (std::size_t k = 0; k < 5; ++k) e(static_cast<Eigen::Index>(k)) = linear[k];
  const Eigen::VectorXd wanted =
      rigid_readings(fixture, 7e-3, {}) + rigid_jacobian(fixture, 7e-3, {}) * e;
  EXPECT_GT((rigid_readings(fixture, 7e-3, linear) - wanted).norm(), 1e-5);
  const AxisErrors found =
      solve_rigid(fixture, 7e-3, {wanted.data(), wanted.data() + wanted.size()}, {1, 1, 1, 1, 1});
  ASSERT_TRUE(found.valid) << found.reason;
  EXPECT_LT((rigid_readings(fixture, 7e-3, found.local) - wanted).norm(), 1e-14);
}

}  // namespace
}  // namespace mdof::algo
