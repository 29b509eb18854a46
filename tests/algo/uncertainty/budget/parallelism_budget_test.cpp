// Budgets of parallelism, which is the slope of motion B minus the slope of motion A. Probe D has a
// scale error. At the fixture only D measures EYX, so the error of a slope s is s times the scale
// error. Errors that are common to both runs add with their signs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/uncertainty/budget/two_runs.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

Run sloping_run(const Rig& rig, double slope_y, double slope_z) {
  SyntheticRun synthetic{.rig = rig, .runs = 2};
  synthetic.truth = [=](double d) { return Errors5{slope_y * d, slope_z * d, 0, 0, 0}; };
  return synthetic.measure();
}

const BudgetLine* line_named(const Budget& budget, const std::string& name) {
  const auto found =
      std::find_if(budget.lines.begin(), budget.lines.end(),
                   [&](const BudgetLine& line) { return contributor_text(line.name) == name; });
  return found == budget.lines.end() ? nullptr : &*found;
}

TEST(ParallelismBudget, CommonProbeErrorsAddWithTheirSigns) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 1000");
  const auto budgets =
      parallelism_budgets(rig, sloping_run(rig, 10e-6, 50e-6), rig, sloping_run(rig, 30e-6, 20e-6));
  ASSERT_TRUE(budgets) << budgets.error().message;
  const auto& [y, z] = *budgets;
  EXPECT_EQ(y.figure, "EYX_parallelism_urad");
  EXPECT_EQ(z.figure, "EZX_parallelism_urad");
  EXPECT_NEAR(y.value, 20e-6, 1e-11);
  EXPECT_NEAR(z.value, -30e-6, 1e-11);
  const BudgetLine* both = line_named(y, "A and B, probe D: sensitivity");
  ASSERT_NE(both, nullptr);
  EXPECT_NEAR(both->contribution, 1e-3 * (30e-6 - 10e-6), 1e-12);
  EXPECT_NEAR(both->value, 1000, 1e-9);
  EXPECT_EQ(both->unit, "ppm");
  EXPECT_NEAR(y.u, 20e-9, 1e-12);
  EXPECT_NEAR(y.U, 1.96 * 20e-9, 0.001 * 40e-9);
  EXPECT_NEAR(line_named(z, "A and B, probe D: sensitivity")->contribution, 0, 1e-13);
  // Three lines: the noise of A, the noise of B, and the common sensitivity of probe D.
  EXPECT_EQ(y.lines.size(), 3u);
  EXPECT_NE(line_named(y, "A, noise and repeatability"), nullptr);
  EXPECT_NE(line_named(y, "B, noise and repeatability"), nullptr);
  EXPECT_FALSE(y.is_single_run);
  ASSERT_EQ(y.not_declared.size() % 2, 0u);
  EXPECT_EQ(y.not_declared.front().substr(0, 2), "A ");
  EXPECT_EQ(y.not_declared.back().substr(0, 2), "B ");
}

// Probes with different certificates are independent, and so are the quantities that belong to one
// set-up. The squares of their contributions add.
TEST(ParallelismBudget, SeparateErrorsAreIndependent) {
  const Rig a = test::rig_x_with("D", "u_sensitivity_ppm = 1000\ncertificate = \"1\""),
            b = test::rig_x_with("D", "u_sensitivity_ppm = 1000\ncertificate = \"2\"");
  const auto budgets =
      parallelism_budgets(a, sloping_run(a, 30e-6, 0), b, sloping_run(b, -40e-6, 0));
  ASSERT_TRUE(budgets) << budgets.error().message;
  const Budget& y = budgets->front();
  EXPECT_NEAR(y.value, -70e-6, 1e-11);
  ASSERT_NE(line_named(y, "A, probe D: sensitivity"), nullptr);
  ASSERT_NE(line_named(y, "B, probe D: sensitivity"), nullptr);
  EXPECT_NEAR(line_named(y, "A, probe D: sensitivity")->contribution, -30e-9, 1e-12);
  EXPECT_NEAR(line_named(y, "B, probe D: sensitivity")->contribution, -40e-9, 1e-12);
  EXPECT_NEAR(y.u, 50e-9, 1e-12);
  EXPECT_EQ(y.lines.size(), 4u);
  // The largest contribution comes first.
  EXPECT_EQ(contributor_text(y.lines.front().name), "B, probe D: sensitivity");
  EXPECT_NEAR(y.lines[0].share, 0.64, 1e-6);
  EXPECT_NEAR(y.lines[1].share, 0.36, 1e-6);
}

// Rig B declares an uncertainty that rig A does not declare.
TEST(ParallelismBudget, UsesDeclarationsOfOneRig) {
  const Rig plain = test::rig_x(),
            b = test::rig_x_with("D", "u_sensitivity_ppm = { u = 1000, dof = 4 }");
  const auto found =
      parallelism_budgets(plain, sloping_run(plain, 30e-6, 0), b, sloping_run(b, -40e-6, 0));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->front().u, 40e-9, 1e-12);
  EXPECT_NEAR(found->front().freedom, 4, 1e-3);
  EXPECT_NEAR(found->front().coverage_factor, 2.776, 1e-3);  // GUM table G.2
  const auto turned =
      parallelism_budgets(b, sloping_run(b, -40e-6, 0), plain, sloping_run(plain, 30e-6, 0));
  ASSERT_NE(line_named(turned->front(), "A, probe D: sensitivity"), nullptr);
  EXPECT_NEAR(line_named(turned->front(), "A, probe D: sensitivity")->contribution, 40e-9, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
