// Redundant probes are weighted by their uncertainty. The expected change is the weighted
// least-squares solution to first order, by the normal equations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "algo/model/rigid.h"
#include "algo/model/solver.h"

namespace mdof::algo {
namespace {

Solver seven_probes() {
  const char* all[] = {"A\"\nposition_mm = [10, 0, 0]\nmeasures = \"+Z\"",
                       "B\"\nposition_mm = [0, 10, 0]\nmeasures = \"+Z\"",
                       "C\"\nposition_mm = [0, -10, 0]\nmeasures = \"+Z\"",
                       "D\"\nposition_mm = [0, 15, 20]\nmeasures = \"+Y\"",
                       "E\"\nposition_mm = [10, 15, 20]\nmeasures = \"+Y\"",
                       "F\"\nposition_mm = [-10, 5, 0]\nmeasures = \"+Z\"",
                       "G\"\nposition_mm = [-10, 15, 10]\nmeasures = \"+Y\""};
  std::string text = "name = \"test\"\naxis = \"X\"\n";
  for (const char* probe : all)
    text += std::string("[[probe]]\nrange_um = 200\nid = \"") + probe + "\n";
  return Solver::create(parse_rig(text, "rig.toml").value(), Model::rigid).value();
}

constexpr double kWeightedTravel_m = 12e-3;
const std::vector<double> kProbesU_m = {1e-9, 2e-9, 5e-9, 1e-9, 3e-9, 4e-9, 2e-9};

struct SevenReadings {
  std::vector<double> all;
  Eigen::MatrixXd jacobian;
};
SevenReadings simulated_seven_readings(const Solver& solver, const Errors5& truth) {
  const Eigen::VectorXd r = rigid_readings(solver.fixture(), kWeightedTravel_m, truth);
  return {{r.data(), r.data() + r.size()},
          rigid_jacobian(solver.fixture(), kWeightedTravel_m, truth)};
}

// Change of the errors if the readings change by `change`: (J'WJ)^-1 J'W change.
Eigen::VectorXd by_normal_equations(const Eigen::MatrixXd& J, const Eigen::VectorXd& weights,
                                    const Eigen::VectorXd& change) {
  const Eigen::MatrixXd W = weights.asDiagonal();
  return (J.transpose() * W * J).inverse() * (J.transpose() * W * change);
}

TEST(ProbeWeights, FollowFromTheUncertainties) {
  const Solver solver = seven_probes();
  const Errors5 truth = {2e-6, -1e-6, 1e-4, -2e-4, 3e-4};
  const SevenReadings nominal = simulated_seven_readings(solver, truth);
  for (const bool known : {true, false})
    for (std::size_t bad = 0; bad < 7; ++bad) {
      std::vector<double> readings = nominal.all, u = kProbesU_m;
      readings[bad] += 10e-9;
      if (!known) u[3] = 0;  // if one u is unknown, all weights are equal
      Eigen::VectorXd weights(7), change = Eigen::VectorXd::Zero(7);
      for (Eigen::Index k = 0; k < 7; ++k) {
        const double u_nm = 1e9 * kProbesU_m[static_cast<std::size_t>(k)];
        weights[k] = known ? 1 / (u_nm * u_nm) : 1;
      }
      change[static_cast<Eigen::Index>(bad)] = 10e-9;
      const AxisErrors found = solver.solve(kWeightedTravel_m, readings, u);
      ASSERT_TRUE(found.valid) << found.reason;
      const Eigen::VectorXd expected = by_normal_equations(nominal.jacobian, weights, change);
      for (std::size_t e = 0; e < 5; ++e)
        EXPECT_NEAR(found.local[e] - truth[e], expected[static_cast<Eigen::Index>(e)],
                    e < 2 ? 1e-13 : 1e-11)
            << known << bad << e;
    }
}

// A probe without a reading has the weight 0, and its u is not needed.
TEST(ProbeWeights, LostProbeNeedsNoU) {
  const Solver solver = seven_probes();
  const Errors5 truth = {2e-6, -1e-6, 1e-4, -2e-4, 3e-4};
  SevenReadings nominal = simulated_seven_readings(solver, truth);
  std::vector<double> readings = nominal.all, u = kProbesU_m;
  readings[6] = std::nan("");
  u[6] = std::nan("");
  readings[0] += 10e-9;
  Eigen::VectorXd weights(7), change = Eigen::VectorXd::Zero(7);
  for (Eigen::Index k = 0; k < 7; ++k)
    weights[k] = k == 6 ? 0 : 1e-18 / std::pow(kProbesU_m[static_cast<std::size_t>(k)], 2);
  change[0] = 10e-9;
  const AxisErrors found = solver.solve(kWeightedTravel_m, readings, u);
  ASSERT_TRUE(found.valid) << found.reason;
  const Eigen::VectorXd expected = by_normal_equations(nominal.jacobian, weights, change);
  for (std::size_t e = 0; e < 5; ++e)
    EXPECT_NEAR(found.local[e] - truth[e], expected[static_cast<Eigen::Index>(e)],
                e < 2 ? 1e-13 : 1e-11);
  // The covariance equals the inverse matrix of the normal equations.
  const Eigen::MatrixXd W = (1e18 * weights).asDiagonal();
  const Eigen::MatrixXd C = (nominal.jacobian.transpose() * W * nominal.jacobian).inverse();
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j)
      EXPECT_NEAR(
          found.covariance[static_cast<std::size_t>(5 * i + j)] / std::sqrt(C(i, i) * C(j, j)),
          C(i, j) / std::sqrt(C(i, i) * C(j, j)), 1e-5);
}

}  // namespace
}  // namespace mdof::algo
