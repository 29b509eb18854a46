// Correlation of the errors of one set of probes. By hand, of the default fixture (B and C at
// y = 10 and -10 mm, A at x = 10, D at z = 20, E at x = 10 beside it), with equal noise s of all
// probes: EAX = (B - C) / 20 mm, EYX = D + 20 mm EAX, ECX = (E - D) / 10 mm, EZX = (B + C) / 2,
// EBX = (EZX - A) / 10 mm.
#include "algo/compensation/error_correlation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/compensation/declared_uncertainty.h"
#include "tests/algo/compensation/table_lever.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kIsEYX = 0, kIsEZX = 1, kIsEAX = 2, kIsEBX = 3, kIsECX = 4;

struct Case {
  CompensationTable table;
  std::vector<Covariance5> correlations;
  double of(std::size_t k, std::size_t l, std::size_t row) const {
    return correlations[row][k * kErrorCount + l];
  }
};

// EYX bends; `noise`: u of all values by noise.
Case made_of(const Rig& rig, double noise) {
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{2e-3 * d * d, 0, 0, 0, 0}; };
  const std::vector<Run> runs{synthetic.measure()};
  TableOptions options;
  options.remove_slope = false;
  options.stated = kAtFixture;
  Case c{build_table(runs, options).value(), {}};
  for (auto& u : c.table.u_forward) u.assign(c.table.position_m.size(), noise);
  EXPECT_TRUE(add_declared_uncertainty(c.table, {rig}, runs, options));
  c.correlations = error_correlations(c.table, {rig}, runs, options).value().combined;
  return c;
}

TEST(ErrorCorrelation, OfEqualNoiseIsThatOfTheFixture) {
  const Case c = made_of(test::rig_x_with("", ""), 1e-9);
  const std::size_t row = 2;
  // Straightness is as measured, angles less the first target: 1/sqrt(2) between them is left.
  EXPECT_NEAR(c.of(kIsEYX, kIsEAX, row), 1 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(c.of(kIsEYX, kIsECX, row), -1 / std::sqrt(12.0), 1e-3);
  EXPECT_NEAR(c.of(kIsEZX, kIsEBX, row), 1 / std::sqrt(6.0), 1e-3);
  EXPECT_NEAR(c.of(kIsEAX, kIsECX, row), 0, 1e-3);
  EXPECT_NEAR(c.of(kIsEYX, kIsEZX, row), 0, 1e-3);
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t l = 0; l < kErrorCount; ++l) {
      EXPECT_NEAR(c.of(k, l, row), c.of(l, k, row), 1e-12);
      if (k == l) {
        EXPECT_EQ(c.of(k, l, row), 1);
      }
    }
  EXPECT_EQ(c.of(kIsEYX, kIsEAX, 0), 0);  // there the angle is 0 by definition
}

// A gain of D alone: EYX by s D, ECX by -s (D - D0) / 10 mm. At x = 10 mm they cancel.
TEST(ErrorCorrelation, AFaultOfOneProbeMovesItsErrorsTogether) {
  const Case c = made_of(test::rig_x_with("D", "u_sensitivity_ppm = 1000"), 0);
  const std::size_t last = c.table.position_m.size() - 1;
  ASSERT_GT(c.table.u_declared[kIsEYX][last], 1e-9);
  EXPECT_NEAR(c.of(kIsEYX, kIsECX, last), -1, 1e-9);
  const Eigen::Vector3d beside(10e-3, 0, 0);
  const auto u = [&](const std::vector<Covariance5>& together) {
    return test::u_of_tool(test::machine_of(c.table, beside, together), c.table, last).y();
  };
  const double alone = c.table.u_declared[kIsEYX][last];
  EXPECT_NEAR(u({}), std::sqrt(2.0) * alone, 1e-3 * alone);
  EXPECT_NEAR(u(c.correlations), 0, 1e-3 * alone);
}

}  // namespace
}  // namespace mdof::algo
