// u and U of a range that is smaller than the uncertainties of its deviations.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kUOfEachTarget_rad = 1e-6;
constexpr std::size_t kIndexOfEAX = 2;

// The budgets of a run whose EAX has these errors and, at each of its nine targets, an independent
// error with the standard uncertainty kUOfEachTarget_rad.
RunBudgets nine_independent_errors(const std::function<double(double travel_m)>& EAX_rad) {
  const Rig rig = test::rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .runs = 1};
  synthetic.truth = [&](double d) { return Errors5{0, 0, EAX_rad(d), 0, 0}; };
  const Run run = synthetic.measure();
  RunBudgets budgets(rig, run);
  std::vector<PointShifts> parts(9, PointShifts(run.points.size()));
  for (std::size_t j = 0; j < run.points.size(); ++j)
    parts[static_cast<std::size_t>(run.points[j].target) - 1][j][kIndexOfEAX] = kUOfEachTarget_rad;
  budgets.add({{}, "key", {kUOfEachTarget_rad}, 1e6, "urad", nullptr}, parts);
  return budgets;
}

// The tables of control charts and of the studentized range give the range of nine independent
// normal numbers with the standard deviation 1: mean 2.970 (d2), standard deviation 0.808 (d3),
// 95 % point 4.387. The true range may be 0. First order gives u = 0.17 only, because +1 and -1 at
// one target cause nearly the same range.
TEST(SmallRange, HasUAndTheIntervalOfNineIndependentErrors) {
  const RunBudgets budgets =
      nine_independent_errors([](double d) { return d == 0 ? 0.1 * kUOfEachTarget_rad : 0; });
  const Figure figure = range_figure(Axis::x, kIndexOfEAX);
  const Budget range = budgets.of(figure);
  EXPECT_NEAR(range.value / kUOfEachTarget_rad, 0.1, 1e-3);
  EXPECT_LT(budgets.first_order(figure).u / kUOfEachTarget_rad, 0.2);
  EXPECT_TRUE(range.u_by_trials);
  EXPECT_NEAR(range.u / kUOfEachTarget_rad, std::hypot(2.970, 0.808), 0.06);
  EXPECT_NEAR(range.U / kUOfEachTarget_rad, 4.387, 0.13);
  EXPECT_NEAR(range.coverage_factor, 1.43, 0.06);
}

// The changes have a t distribution of one degree of freedom (Cauchy), which has no standard
// deviation. The factor of 95 % of this distribution is 12.7.
TEST(SmallRange, TheStandardDeviationOfFarTrialsIsNotU) {
  constexpr int kTrials = 5000, kStep = 1733;  // the second deviation in another order
  std::vector<double> changes;
  const auto cauchy = [](int i) { return std::tan(M_PI * ((i + 0.5) / kTrials - 0.5)); };
  for (int i = 0; i < kTrials; ++i) {
    changes.push_back(cauchy(i));
    changes.push_back(cauchy((i * kStep) % kTrials));
  }
  Budget range;
  range.value = 0.1;
  range.u = 0.01;
  range.coverage_factor = 12.7;
  state_interval(range, RangeTrials({0, 0.1}, std::move(changes)));
  EXPECT_TRUE(range.u_by_trials);
  EXPECT_GT(range.U, 10);
  EXPECT_NEAR(range.coverage_factor, 12.7, 1e-9);
}

// Only the two ends of a large range count, so u is √2.
TEST(SmallRange, ALargeRangeKeepsUOfFirstOrder) {
  const Budget range = nine_independent_errors([](double d) {
                         return 100 * kUOfEachTarget_rad * d / 40e-3;
                       }).of(range_figure(Axis::x, kIndexOfEAX));
  EXPECT_FALSE(range.u_by_trials);
  EXPECT_NEAR(range.u / kUOfEachTarget_rad, std::sqrt(2), 0.01);
  EXPECT_NEAR(range.coverage_factor, 1.96, 0.1);
}

}  // namespace
}  // namespace mdof::algo
