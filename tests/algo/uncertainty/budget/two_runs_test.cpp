// The distributions of the quantities in the trials of a squareness, for two runs of which only the
// first one has a declared uncertainty.
#include "algo/uncertainty/budget/two_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

// Half of the 95 % interval of the trials, divided by their u.
double half_interval_by_u(const std::string& of_D) {
  const Rig x = test::rig_x_with("D", of_D);
  Rig y = test::rig_x();
  y.axis = Axis::y;
  SyntheticRun along_x{.rig = x, .model = Model::exact, .runs = 1};
  along_x.truth = [](double d) { return Errors5{0, 1e-3 * d, 0, 0, 2e-3 * d}; };
  mdof::Run run_y = SyntheticRun{.rig = test::rig_x(), .runs = 1}.measure();
  run_y.header.axis = Axis::y;
  const SquareArtefact square{.angle_error_rad = 0, .u_rad = 0, .corner = -1};
  const Budget found =
      squareness_budget(x, along_x.measure(), y, run_y, square, {.trials = 50000}).value();
  EXPECT_TRUE(found.trials);
  EXPECT_NEAR(found.trials->u / found.u, 1, 0.02);
  return (found.trials->high - found.trials->low) / 2 / found.trials->u;
}

// The 95 % interval of a rectangular distribution ends at 0.95 √3 u. The tilts of a probe are two
// quantities, whose sum is drawn from the normal distribution: it ends at 1.96 u.
TEST(TwoRuns, SingleQuantitiesHaveTheirDeclaredDistribution) {
  EXPECT_NEAR(
      half_interval_by_u("u_sensitivity_ppm = { u = 1000, distribution = \"rectangular\" }"),
      0.95 * std::sqrt(3.0), 0.02);
  EXPECT_NEAR(half_interval_by_u("u_sensitivity_ppm = 1000"), 1.96, 0.03);
  EXPECT_NEAR(half_interval_by_u("u_direction_mrad = { u = 2, distribution = \"rectangular\" }"),
              1.96, 0.03);
}

}  // namespace
}  // namespace mdof::algo
