// Values that are 0 because of rounding or a declaration, or whose uncertainty is unknown.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/budget/two_runs.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

// The axis is straight, so its deviations and a first-order budget contain only rounding errors.
TEST(Budget, RangeOfRoundingErrorsHasTheUOfItsTrials) {
  const Rig rig = test::rig_x();
  SyntheticRun synthetic{.rig = rig, .runs = 1};
  synthetic.truth = [](double d) { return Errors5{3e-6 * d, 0, 0, 0, 0}; };
  synthetic.u_reading_m = 10e-9;
  const Budget b =
      RunBudgets::create(rig, synthetic.measure())->of(straightness_figure(Axis::x, 0));
  EXPECT_LT(b.value, 1e-12);
  EXPECT_GT(b.u, 5e-9);
  EXPECT_GT(b.coverage_factor, 1);
  EXPECT_LT(b.coverage_factor, 4);
}

// An undeclared u is reported as missing. A declared u of 0 adds nothing to the budget.
TEST(Budget, ArtefactWithoutUIsReportedAndZeroUIsNot) {
  const Rig x = test::rig_x();
  Rig y = x;
  y.axis = Axis::y;
  const mdof::Run run_x = SyntheticRun{.rig = x}.measure();
  mdof::Run run_y = run_x;
  run_y.header.axis = Axis::y;
  const auto lacks_u = [&](const std::optional<double>& u_rad) {
    const SquareArtefact square{.angle_error_rad = 0, .u_rad = u_rad, .corner = -1};
    const Budget b = squareness_budget(x, run_x, y, run_y, square).value();
    return std::count(b.not_declared.begin(), b.not_declared.end(), "u_artefact_angle_urad") > 0;
  };
  EXPECT_TRUE(lacks_u(std::nullopt));
  EXPECT_FALSE(lacks_u(0.0));
  EXPECT_FALSE(lacks_u(0.4e-6));
}

// The u of a budget without contributions is 0 only if all uncertainties are declared.
TEST(Budget, ZeroUIsUnknownIfSomethingIsUndeclared) {
  Budget budget;
  budget.lines.resize(1);
  complete(budget);
  EXPECT_EQ(budget.u, 0);
  EXPECT_EQ(budget.U, 0);
  budget.not_declared = {"u_um_per_h"};
  complete(budget);
  EXPECT_TRUE(std::isnan(budget.u));
  EXPECT_TRUE(std::isnan(budget.U));
  EXPECT_TRUE(std::isnan(budget.coverage_factor));
}

}  // namespace
}  // namespace mdof::algo
