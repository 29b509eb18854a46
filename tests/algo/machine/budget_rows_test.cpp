// Tests the rows of a budget whose errors are correlated. Expected values are calculated from the
// covariance matrix (GUM 5.2.2), not from its triangular factor.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/machine/budget/budget.h"
#include "algo/machine/budget/trials.h"

namespace mdof::algo {
namespace {

// Two tables, X and Y, carry the work. The tool is 0.2 m above the reference points.
Machine two_tables() {
  auto parsed = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-Y-X-b-t\"}\ntool = {point_mm = [0, 100, 200]}\n"
      "[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"standing\"\n"
      "[[axis]]\nid = \"Y\"\nholds_at_mm = [0, 0, 0]\npoint = \"standing\"\n",
      "m");
  EXPECT_TRUE(parsed) << parsed.error().message;
  return *parsed;
}

MachineFrame& frame_of(Machine& machine, const char* id) {
  return machine.frames[static_cast<std::size_t>(machine.find(id) - machine.frames.data())];
}

// Declares a value of 0, with this covariance, for errors 1 (EY) and 5 (EC) of the frame.
void declare(MachineFrame& frame, double u_EY, double u_EC, double correlation) {
  ErrorCovariance& all = frame.covariance;
  all.position = {0};
  all.noise.assign(1, {});
  all.declared.assign(1, {});
  all.has[1] = all.has[5] = true;
  all.declared[0][1][1] = u_EY * u_EY;
  all.declared[0][5][5] = u_EC * u_EC;
  all.declared[0][1][5] = all.declared[0][5][1] = correlation * u_EY * u_EC;
  frame.error[1].forward = frame.error[5].forward = {0};
}

BudgetModel model_of(const Machine& machine) {
  return budget_model(machine, {}, MachineApproach::mean, BudgetStage::measured).value();
}

const BudgetRow& row_of(const BudgetModel& model, const std::string& name) {
  for (const BudgetRow& row : model.rows)
    if (row.name == name) return row;
  ADD_FAILURE() << "no row " << name;
  return model.rows.front();
}

// EYX moves the tool along Y only. ECX moves it along X by the arm of 100 mm, and not along Y.
TEST(MachineBudgetRows, EachErrorHasItsOwnUAndSensitivity) {
  Machine machine = two_tables();
  declare(frame_of(machine, "X"), 0.3e-6, 8e-6, 0.8);
  const BudgetModel model = model_of(machine);
  ASSERT_EQ(model.rows.size(), 2u);
  const BudgetRow &EYX = row_of(model, "EYX"), &ECX = row_of(model, "ECX");
  EXPECT_NEAR(EYX.u, 0.3, 1e-12);
  EXPECT_NEAR(ECX.u, 8, 1e-12);  // with the part that is correlated with EYX
  EXPECT_LT((EYX.sensitivity * 1e6 - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((ECX.sensitivity * 1e6 - Eigen::Vector3d(0.1, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(ECX.contribution_m()(0), 0.8e-6, 1e-15);
  // The two errors act in different directions, so their covariance does not count.
  EXPECT_NEAR(EYX.variance_m2, std::pow(0.3e-6, 2), 1e-24);
  EXPECT_NEAR(ECX.variance_m2, std::pow(0.8e-6, 2), 1e-24);
  EXPECT_NEAR(budget_u_m(model).squaredNorm(), EYX.variance_m2 + ECX.variance_m2, 1e-24);
  EXPECT_TRUE(has_correlated_rows(model));
}

// The tool is at the reference points in Y, so ECX has no arm.
TEST(MachineBudgetRows, ErrorWithoutEffectHasNoShare) {
  Machine machine = two_tables();
  machine.tool_m = {0, 0, 0.2};
  declare(frame_of(machine, "X"), 0.3e-6, 8e-6, 0.8);
  BudgetModel model = model_of(machine);
  EXPECT_NEAR(row_of(model, "ECX").variance_m2, 0, 1e-24);
  EXPECT_NEAR(row_of(model, "EYX").variance_m2, std::pow(0.3e-6, 2), 1e-24);
  machine.tool_m = {0, 0.1, 0.2};
  frame_of(machine, "X").covariance.declared[0][1] = {};  // only ECX is uncertain
  frame_of(machine, "X").covariance.declared[0][5][1] = 0;
  model = model_of(machine);
  ASSERT_EQ(model.rows.size(), 1u);
  EXPECT_FALSE(has_correlated_rows(model));
}

// EYX and EYY act along Y. A quantity of both axes and the correlation within X give covariances.
TEST(MachineBudgetRows, SharesContainTheCovariances) {
  Machine machine = two_tables();
  machine.tool_m = {0.1, 0, 0.2};  // EC has the arm 0.1 m along Y
  declare(frame_of(machine, "X"), 0.3e-6, 8e-6, 0.5);
  declare(frame_of(machine, "Y"), 0.4e-6, 0, 0);
  std::array<double, kBodyErrors> on_x{}, on_y{};
  on_x[1] = 0.2e-6;
  on_y[1] = -0.7e-6;
  frame_of(machine, "X").covariance.shared = {{"probe A", {on_x}}};
  frame_of(machine, "Y").covariance.shared = {{"probe A", {on_y}}};
  const BudgetModel model = model_of(machine);
  // Covariance matrix of EYX, ECX, EYY, and their derivatives along Y.
  Eigen::Matrix3d V;
  V << 0.09e-12 + 0.04e-12, 0.5 * 0.3e-6 * 8e-6, -0.14e-12,  //
      0.5 * 0.3e-6 * 8e-6, 64e-12, 0,                        //
      -0.14e-12, 0, 0.16e-12 + 0.49e-12;
  const char* const names[] = {"EYX", "ECX", "EYY"};
  Eigen::Vector3d d;
  for (int k = 0; k < 3; ++k) d(k) = row_of(model, names[k]).sensitivity(1) * 1e6;
  EXPECT_LT((d - Eigen::Vector3d(-1, -0.1, -1)).norm(), 1e-12);
  const Eigen::Vector3d parts = d.cwiseProduct(V * d);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(row_of(model, names[k]).u * 1e-6, std::sqrt(V(k, k)), 1e-18) << names[k];
    EXPECT_NEAR(row_of(model, names[k]).variance_m2, parts(k), 1e-24) << names[k];
  }
  EXPECT_NEAR(budget_u_m(model).squaredNorm(), parts.sum(), 1e-24);
  const ToolError error = tool_error(machine, {}, MachineApproach::mean);
  EXPECT_NEAR(error.u(1), std::sqrt(parts.sum()), 1e-15);
}

// The scale of a row changes u of this error and keeps its correlations.
TEST(MachineBudgetRows, TrialsScaleTheErrorOfARow) {
  Machine machine = two_tables(), halved = two_tables();
  machine.tool_m = halved.tool_m = {0.1, 0, 0.2};
  declare(frame_of(machine, "X"), 0.3e-6, 8e-6, 0.5);
  declare(frame_of(halved, "X"), 0.3e-6, 4e-6, 0.5);
  const auto trials = budget_trials(model_of(machine), 5);
  const auto expected = budget_trials(model_of(halved), 5);
  ASSERT_EQ(trials->quantities(), (std::vector<std::string>{"EYX", "ECX"}));
  EXPECT_NEAR(trials->sizes()[1], 8, 1e-12);
  constexpr std::size_t n = 50;
  std::vector<double> a(4 * n), b(4 * n);
  double* const out_a[4] = {&a[0], &a[n], &a[2 * n], &a[3 * n]};
  double* const out_b[4] = {&b[0], &b[n], &b[2 * n], &b[3 * n]};
  const std::vector<double> scale = {1, 0.5};
  trials->run_scaled(scale, 0, 1, n, out_a);
  expected->run(0, 1, n, out_b);
  for (std::size_t j = 0; j < 4 * n; ++j) ASSERT_NEAR(a[j], b[j], 1e-9) << j;
}

}  // namespace
}  // namespace mdof::algo
