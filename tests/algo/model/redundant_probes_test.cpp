// Errors and covariance from more than five probes. The expected change is the least-squares
// solution to first order, by the normal equations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "algo/model/rigid.h"
#include "algo/model/solver.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

Solver seven_probes() {
  return Solver::create(test::rig_x_redundant(7), Model::rigid).value();
}

constexpr double kTravelOfSeven_m = 12e-3;
constexpr double kLostOfSeven = std::numeric_limits<double>::quiet_NaN();
const Errors5 kErrorsOfSeven = {2e-6, -1e-6, 1e-4, -2e-4, 3e-4};

std::vector<double> readings_of_seven(const Solver& solver) {
  const Eigen::VectorXd r = rigid_readings(solver.fixture(), kTravelOfSeven_m, kErrorsOfSeven);
  return {r.data(), r.data() + r.size()};
}

// `J`: one row for each probe in use.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& J) {
  return (J.transpose() * J).inverse() * J.transpose();
}

void expect_change_of_seven(const AxisErrors& found, const Eigen::VectorXd& expected) {
  ASSERT_TRUE(found.valid) << found.reason;
  for (std::size_t e = 0; e < 5; ++e)
    EXPECT_NEAR(found.local[e] - kErrorsOfSeven[e], expected[static_cast<Eigen::Index>(e)],
                e < 2 ? 1e-13 : 1e-11);
}

// The zero of one probe is off by 10 nm. Its effect on the errors does not depend on the noise of
// the probes at this stop, so that it cancels between the stops.
TEST(RedundantProbes, AZeroHasTheSameEffectAtEachNoise) {
  const Solver solver = seven_probes();
  const Eigen::MatrixXd K =
      pseudo_inverse(rigid_jacobian(solver.fixture(), kTravelOfSeven_m, kErrorsOfSeven));
  for (std::size_t off = 0; off < 7; ++off) {
    std::vector<double> readings = readings_of_seven(solver);
    readings[off] += 10e-9;
    for (const std::vector<double>& u_m :
         {std::vector<double>{1e-9, 2e-9, 5e-9, 1e-9, 3e-9, 4e-9, 2e-9},
          std::vector<double>{9e-9, 2e-9, 1e-9, 4e-9, 1e-9, 1e-9, 0}, std::vector<double>{}})
      expect_change_of_seven(solver.solve(kTravelOfSeven_m, readings, u_m),
                             10e-9 * K.col(static_cast<Eigen::Index>(off)));
  }
}

// The last probe has no reading, and its u is not needed.
TEST(RedundantProbes, CovarianceHasTheUOfEachProbeInUse) {
  const Solver solver = seven_probes();
  std::vector<double> readings = readings_of_seven(solver);
  readings[6] = kLostOfSeven;
  readings[0] += 10e-9;
  const std::vector<double> u_m = {1e-9, 2e-9, 5e-9, 1e-9, 3e-9, 4e-9, kLostOfSeven};
  const AxisErrors found = solver.solve(kTravelOfSeven_m, readings, u_m);
  const Eigen::MatrixXd K =
      pseudo_inverse(rigid_jacobian(solver.fixture(), kTravelOfSeven_m, kErrorsOfSeven).topRows(6));
  expect_change_of_seven(found, 10e-9 * K.col(0));
  const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(u_m.data(), 6);
  const Eigen::MatrixXd C = K * u.cwiseAbs2().asDiagonal() * K.transpose();
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j)
      EXPECT_NEAR(
          found.covariance[static_cast<std::size_t>(5 * i + j)] / std::sqrt(C(i, i) * C(j, j)),
          C(i, j) / std::sqrt(C(i, i) * C(j, j)), 1e-5);
}

// Six probes, of which one is lost. The next probe has u = 0, so that the weights of the five
// probes are equal, and the solution is exact.
TEST(RedundantProbes, FiveOfSixProbesWithAnUnknownUAreExact) {
  const Solver solver = Solver::create(test::rig_x_redundant(6), Model::rigid).value();
  const Eigen::VectorXd r = rigid_readings(solver.fixture(), kTravelOfSeven_m, kErrorsOfSeven);
  for (std::size_t lost = 0; lost < 5; ++lost) {
    std::vector<double> readings(r.data(), r.data() + r.size()), u_m(6, 1e-9);
    readings[lost] = kLostOfSeven;
    u_m[lost + 1] = 0;
    const AxisErrors found = solver.solve(kTravelOfSeven_m, readings, u_m);
    if (lost == 3 || lost == 4) {  // without D or E, the yaw is not seen
      EXPECT_FALSE(found.valid);
      continue;
    }
    expect_change_of_seven(found, Eigen::VectorXd::Zero(5));
  }
}

}  // namespace
}  // namespace mdof::algo
