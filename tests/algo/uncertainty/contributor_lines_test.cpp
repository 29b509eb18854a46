// The lines of a budget show the uncertainty of each contributor as the rig declares it, in the
// unit of its key.
#include <gtest/gtest.h>

#include <map>

#include "algo/uncertainty/budget/two_runs.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

Errors5 curved_axis(double d) {
  return {2e-3 * d * d, 1e-3 * d * d, 1e-3 * d, -2e-3 * d, 3e-3 * d};
}

TEST(ContributorLines, ShowTheDeclaredUncertainties) {
  const Rig rig = test::rig_x_with(
      "B",
      "u_calibration_um = 0.11\nu_sensitivity_ppm = 120\nu_position_mm = [0.13, 0.14, 0.15]\n"
      "u_direction_mrad = 1.6",
      "[encoder]\nu_um = 0.17\n[installation]\nu_angle_mrad = [1.8, 1.9, 2.1]\n"
      "u_offset_mm = [0.22, 0.23, 0.24]\n[drift]\nu_um_per_h = 0.25\n[temperature]\n"
      "u_scale_K = 2\nscale_ppm_per_K = 13\nu_fixture_K = 3\nfixture_ppm_per_K = 9\n"
      "u_square_gradient_K_per_m = [0.1, 0.28, 0.2]\nsquare_ppm_per_K = 11\n"
      "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = 0.29\n"
      "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n");
  const auto all = contributors(
      rig, SyntheticRun{.rig = rig, .stated = kAtCarriage, .truth = curved_axis}.measure());
  ASSERT_TRUE(all) << all.error().message;
  struct Shown {
    double value;
    std::string unit, key;
  };
  const std::map<std::string, Shown> expected = {
      {"probe B: calibration", {0.11, "µm", "u_calibration_um"}},
      {"probe B: sensitivity", {120, "ppm", "u_sensitivity_ppm"}},
      {"probe B: position x", {0.13, "mm", "u_position_mm"}},
      {"probe B: position y", {0.14, "mm", "u_position_mm"}},
      {"probe B: position z", {0.15, "mm", "u_position_mm"}},
      {"probe B: direction", {1.6, "mrad", "u_direction_mrad"}},
      {"installation: angle about x", {1.8, "mrad", "u_angle_mrad"}},
      {"installation: angle about y", {1.9, "mrad", "u_angle_mrad"}},
      {"installation: angle about z", {2.1, "mrad", "u_angle_mrad"}},
      {"installation: offset x", {0.22, "mm", "u_offset_mm"}},
      {"installation: offset y", {0.23, "mm", "u_offset_mm"}},
      {"installation: offset z", {0.24, "mm", "u_offset_mm"}},
      {"probe A: drift", {0.25, "µm/h", "u_um_per_h"}},
      {"probe E: drift", {0.25, "µm/h", "u_um_per_h"}},
      {"plane top: flatness", {0.29, "µm", "u_flatness_um"}},
      {"encoder", {0.17, "µm", "u_um"}},
      {"scale: expansion", {26, "ppm", "[temperature] u_scale_K"}},
      {"fixture: expansion", {27, "ppm", "[temperature] u_fixture_K"}},
      {"square: temperature gradient", {0.28, "K/m", "[temperature] u_square_gradient_K_per_m"}}};
  std::size_t found = 0;
  for (const Contributor& c : *all) {
    const auto at = expected.find(contributor_text(c.name));
    if (at == expected.end()) continue;
    ++found;
    const BudgetLine line = RunBudgets::line(c, {3, 4});
    EXPECT_NEAR(line.value, at->second.value, 1e-12) << at->first;
    EXPECT_EQ(line.unit, at->second.unit) << at->first;
    EXPECT_EQ(line.key, at->second.key) << at->first;
    EXPECT_EQ(line.contribution, 5) << at->first;
    EXPECT_EQ(RunBudgets::line(c, {-2}).contribution, -2) << at->first;
  }
  EXPECT_EQ(found, expected.size());
  EXPECT_EQ(all->size(), expected.size() + 3) << "three more probes drift";
}

// EC0Y = -slope(EXY) - slope(EYX) + corner × angle error of the square.
TEST(ContributorLines, SquareIsALineOfTheBudgetOfEC0Y) {
  const Rig x = test::rig_x();
  for (const int corner : {1, -1}) {
    const SquareArtefact square{30e-6, 2e-6, corner};
    const auto budget = squareness_budget(x, SyntheticRun{.rig = x}.measure(), x,
                                          SyntheticRun{.rig = x}.measure(), square);
    ASSERT_TRUE(budget) << budget.error().message;
    EXPECT_NEAR(budget->value, corner * 30e-6, 1e-15);
    const BudgetLine& line = budget->lines.front();
    EXPECT_EQ(contributor_text(line.name), "angle of the square");
    EXPECT_EQ(line.key, "u_artefact_angle_urad");
    EXPECT_NEAR(line.value, 2, 1e-12);
    EXPECT_EQ(line.unit, "µrad");
    EXPECT_NEAR(line.contribution, corner * 2e-6, 1e-15);
    EXPECT_NEAR(budget->u, 2e-6, 1e-15);
  }
}

}  // namespace
}  // namespace mdof::algo
