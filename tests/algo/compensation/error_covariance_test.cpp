// Covariance of the errors that one set of probes measures. Calculated by hand for the default
// fixture with the same noise of all probes: B and C are at y = 10 and -10 mm, A at x = 10 mm, D at
// z = 20 mm, E at x = 10 mm beside D.
// EAX = (B - C) / 20 mm
// EYX = D + 20 mm EAX
// ECX = (E - D) / 10 mm
// EZX = (B + C) / 2
// EBX = (EZX - A) / 10 mm
#include "algo/compensation/error_covariance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/compensation/declared_uncertainty.h"
#include "tests/algo/compensation/table_lever.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kEYXIndex = 0, kEZXIndex = 1, kEAXIndex = 2, kEBXIndex = 3, kECXIndex = 4;

struct Case {
  CompensationTable table;
  ErrorCovariances covariances;
  double covariance(std::size_t k, std::size_t l, std::size_t row) const {
    const std::size_t kl = k * kErrorCount + l;
    return covariances.noise[row][kl] +
           (covariances.declared.empty() ? 0 : covariances.declared[row][kl]);
  }
  // Correlation coefficient of the errors k and l in a row of the table.
  double of(std::size_t k, std::size_t l, std::size_t row) const {
    return covariance(k, l, row) / std::sqrt(covariance(k, k, row) * covariance(l, l, row));
  }
};

// EYX is a parabola. `noise`: u that noise causes in every value, m or rad.
Case make_error_case(const Rig& rig, double noise) {
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{2e-3 * d * d, 0, 0, 0, 0}; };
  const std::vector<Run> runs{synthetic.measure()};
  TableOptions options;
  options.remove_slope = false;
  options.stated = kAtFixture;
  Case c{build_table(runs, options).value(), {}};
  for (auto* side : {&c.table.u_forward, &c.table.u_reverse})
    for (auto& u : *side) u.assign(c.table.position_m.size(), noise);
  EXPECT_TRUE(add_declared_uncertainty(c.table, {rig}, runs, options));
  c.covariances = error_covariances(c.table, {rig}, runs, options).value();
  return c;
}

TEST(ErrorCovariance, EqualNoiseGivesTheFixtureCorrelations) {
  const Case c = make_error_case(test::rig_x_with("", ""), 1e-9);
  const std::size_t row = 2;
  // The straightness errors are as measured, but the angles are relative to the first target. This
  // reduces the correlation between both by the factor 1/sqrt(2).
  EXPECT_NEAR(c.of(kEYXIndex, kEAXIndex, row), 1 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(c.of(kEYXIndex, kECXIndex, row), -1 / std::sqrt(12.0), 1e-3);
  EXPECT_NEAR(c.of(kEZXIndex, kEBXIndex, row), 1 / std::sqrt(6.0), 1e-3);
  EXPECT_NEAR(c.of(kEAXIndex, kECXIndex, row), 0, 1e-3);
  EXPECT_NEAR(c.of(kEYXIndex, kEZXIndex, row), 0, 1e-3);
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t l = 0; l < kErrorCount; ++l) {
      EXPECT_NEAR(c.of(k, l, row), c.of(l, k, row), 1e-12);
      if (k == l) {
        EXPECT_NEAR(c.covariance(k, l, row), 1e-18, 1e-27);
      }
    }
  EXPECT_EQ(c.of(kEYXIndex, kEAXIndex, 0), 0);  // at the first target the angle is 0
}

// A scale error s of probe D changes EYX by s d and ECX by -s (d - d0) / 10 mm; d is its reading,
// d0 its reading at the first target. A tool at x = 10 mm is not affected, because both changes
// cancel there.
TEST(ErrorCovariance, ErrorOfOneProbeCorrelatesStraightnessAndYaw) {
  const Case c = make_error_case(test::rig_x_with("D", "u_sensitivity_ppm = 1000"), 0);
  const std::size_t last = c.table.position_m.size() - 1;
  ASSERT_GT(c.table.u_declared[kEYXIndex][last], 1e-9);
  EXPECT_NEAR(c.of(kEYXIndex, kECXIndex, last), -1, 1e-9);
  const Eigen::Vector3d beside(10e-3, 0, 0);
  const auto u = [&](const ErrorCovariances& together) {
    return test::tool_uncertainty(test::machine_of(c.table, beside, together), c.table, last).y();
  };
  const double alone = c.table.u_declared[kEYXIndex][last];
  EXPECT_NEAR(u({}), std::sqrt(2.0) * alone, 1e-3 * alone);
  EXPECT_NEAR(u(c.covariances), 0, 1e-3 * alone);
}

// The correlation is the same if all targets were approached in reverse only.
TEST(ErrorCovariance, UsesTheOnlyMeasuredApproach) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 1000");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{2e-3 * d * d, 0, 0, 0, 0}; };
  mdof::Run run = synthetic.measure();
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.point.direction > 0; });
  TableOptions options;
  options.remove_slope = false;
  options.stated = kAtFixture;
  const auto table = build_table({run}, options).value();
  const auto declared = error_covariances(table, {rig}, {run}, options).value().declared.back();
  const auto of = [&](std::size_t k, std::size_t l) { return declared[k * kErrorCount + l]; };
  ASSERT_GT(of(kEYXIndex, kEYXIndex), 1e-18);
  EXPECT_NEAR(
      of(kEYXIndex, kECXIndex) / std::sqrt(of(kEYXIndex, kEYXIndex) * of(kECXIndex, kECXIndex)), -1,
      1e-9);
}

// The yaw of the target is proportional to the square of the travel. In the table `off` the
// readings of probe E are 1000 ppm too large. The angle is set to 0 in the middle of the travel, so
// the scale of E has no effect there.
TEST(ErrorCovariance, UsesTheZeroPositionOfAngles) {
  const Rig rig = test::rig_x_with("E", "u_sensitivity_ppm = 1000");
  const auto tables = [&](double off, const TableOptions& options) {
    SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
    synthetic.truth = [](double d) { return Errors5{0, 0, 0, 0, 0.5 * d * d}; };
    synthetic.added = [off](std::size_t k, double, double reading_m, double) {
      return k == 4 ? off * reading_m : 0;
    };
    const std::vector<mdof::Run> runs{synthetic.measure()};
    return std::pair(build_table(runs, options).value(), runs);
  };
  TableOptions options;
  options.stated = kAtFixture;
  const std::size_t middle = tables(0, options).first.position_m.size() / 2;
  options.angles_zero_m = tables(0, options).first.position_m[middle];
  const auto [table, runs] = tables(0, options);
  const CompensationTable off = tables(1e-3, options).first;
  const auto declared = error_covariances(table, {rig}, runs, options).value().declared;
  const std::size_t last = table.position_m.size() - 1, own = kECXIndex * kErrorCount + kECXIndex;
  EXPECT_NEAR(table.forward[kECXIndex][middle], 0, 1e-15);
  EXPECT_NEAR(declared[middle][own], 0, 1e-24);
  for (const std::size_t row : {std::size_t{0}, middle / 2, last}) {
    const double moved = off.forward[kECXIndex][row] - table.forward[kECXIndex][row];
    ASSERT_GT(std::abs(moved), 1e-8) << row;
    EXPECT_NEAR(std::sqrt(declared[row][own]), std::abs(moved), 1e-3 * std::abs(moved)) << row;
  }
}

}  // namespace
}  // namespace mdof::algo
