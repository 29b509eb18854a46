// The u of a run that is solved with the simplified model covers the error of this model.
#include "algo/uncertainty/effects/model_contributor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using test::rig_x_with;

constexpr double kAngle_rad = 559e-6;

// A run whose angles grow along the axis to 559 µrad.
Run tilting(const Rig& rig, Model model) {
  SyntheticRun synthetic{.rig = rig, .model = model, .runs = 1};
  synthetic.truth = [](double d) {
    const double angle = kAngle_rad * d / 40e-3;
    return Errors5{0, 20e-6, angle, angle, angle};
  };
  return synthetic.measure();
}

TEST(ModelContributor, CoversTheErrorOfTheSimplifiedModel) {
  const Rig rig = rig_x_with("", "");
  const auto simplified = tilting(rig, Model::simplified), truth = tilting(rig, Model::rigid);
  const RunUncertainty found = run_uncertainty(rig, simplified);
  EXPECT_TRUE(found.noise_only);  // the rig declares no uncertainties
  double most_um = 0;
  for (std::size_t j = 0; j < simplified.points.size(); ++j) {
    const auto off = [&](std::size_t e) {
      return simplified.points[j].errors.local[e] - truth.points[j].errors.local[e];
    };
    const auto& names = error_names(Axis::x);
    for (std::size_t k = 0; k < kErrorCount; ++k) {  // a true rotation differs by some nm more
      const double u = std::fmax(0, found.points[j].u[k]);  // 0 at the first point
      EXPECT_LE(std::abs(off(names[k].local)), 2 * u + 3e-9) << j << " " << names[k].name;
    }
    most_um = std::max(most_um, 1e6 * std::abs(off(names[0].local)));
  }
  EXPECT_GT(most_um, 0.005);  // large enough for the test
}

TEST(ModelContributor, IsABudgetLineOfTheSimplifiedModelOnly) {
  const Rig rig = rig_x_with("D", "u_calibration_um = 0.01");
  EXPECT_TRUE(model_contributor(rig, tilting(rig, Model::simplified), Model::simplified));
  EXPECT_FALSE(model_contributor(rig, tilting(rig, Model::exact), Model::exact));
  const auto lines_of = [&](Model model) {
    return RunBudgets::create(rig, tilting(rig, model))
        .value()
        .of(error_figure(Axis::x, 0, 9))
        .lines.size();
  };
  EXPECT_EQ(lines_of(Model::simplified), lines_of(Model::exact) + 1);
}

// The contributor has one part, which is one standard uncertainty; it has no key, and the factor of
// its unit is 1.
TEST(ModelContributor, IsOneStandardUncertainty) {
  const Rig rig = rig_x_with("", "");
  const auto run = tilting(rig, Model::simplified);
  const auto found = model_contributor(rig, run, Model::simplified);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->declared.u, 1);
  EXPECT_EQ(found->to_unit, 1);
  EXPECT_EQ(found->key, "");
  ASSERT_EQ(found->parts().size(), 1u);
  EXPECT_EQ(found->parts()[0].size(), run.points.size());
}

// A point without errors has no shift; the shifts of the other points remain.
TEST(ModelContributor, PointsWithoutErrorsAreNotShifted) {
  const Rig rig = rig_x_with("", "");
  auto run = tilting(rig, Model::simplified);
  const auto whole = model_contributor(rig, run, Model::simplified)->parts();
  run.points[6].errors.valid = false;
  const auto some = model_contributor(rig, run, Model::simplified)->parts();
  ASSERT_EQ(some.size(), 1u);
  ASSERT_EQ(some[0].size(), run.points.size());
  EXPECT_NE(whole[0][6], Errors5{});
  for (std::size_t j = 0; j < run.points.size(); ++j)
    EXPECT_EQ(some[0][j], j == 6 ? Errors5{} : whole[0][j]) << j;
}

}  // namespace
}  // namespace mdof::algo
