// Tests which errors a budget reports because no source acts on them.
#include <gtest/gtest.h>

#include <algorithm>

#include "algo/machine/budget/budget.h"
#include "schema/machine/machine.h"

namespace mdof::algo {
namespace {

// A squareness is one error of two axes. The budget reports it once, and only if no source acts on
// it at either axis.
TEST(MachineBudget, NamesASquarenessWithoutACauseOnce) {
  std::string text = "name = \"m\"\nmachine = {chain = \"w-X-b-Y-Z-t\"}\n";
  for (const char* id : {"X", "Y", "Z"})
    text +=
        std::string("[[axis]]\nid = \"") + id + "\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n";
  auto parsed = parse_machine(text, "m");
  ASSERT_TRUE(parsed) << parsed.error().message;
  Machine machine = *parsed;
  machine.tool_m = {0.01, 0.02, -0.1};
  const Command at = {0.03, 0.04, 0.05, 0, 0, 0};
  const auto squares = [&](const char* axis, std::size_t k) {
    Machine m = machine;
    if (*axis)
      m.sources.push_back(
          {"s",
           "urad",
           1,
           SourceShape::normal,
           {{static_cast<std::size_t>(m.find(axis) - m.frames.data()), k, true, 1e-6, 0, 0}}});
    const auto model = budget_model(m, at, MachineApproach::mean, BudgetStage::designed);
    EXPECT_TRUE(model) << model.error().message;
    std::vector<std::string> found;
    for (const std::string& name : model->not_declared)
      if (name.find('0') != std::string::npos) found.push_back(name);
    std::sort(found.begin(), found.end());
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(squares("", 0), (Names{"EA0Z", "EB0Z", "EC0Y"}));
  EXPECT_EQ(squares("X", 5), (Names{"EA0Z", "EB0Z"}));  // source of EC0X
  EXPECT_EQ(squares("Y", 5), (Names{"EA0Z", "EB0Z"}));  // source of EC0Y
  EXPECT_EQ(squares("X", 4), (Names{"EA0Z", "EC0Y"}));  // source of EB0X
  EXPECT_EQ(squares("Z", 3), (Names{"EB0Z", "EC0Y"}));
}

// EC0X and EC0Y are one angle. Its measured value contains the effect of the source at either axis.
TEST(MachineBudget, MeasuredSquarenessReplacesItsSourceAtEitherAxis) {
  auto parsed = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-X-b-Y-t\"}\n"
      "[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n"
      "[[axis]]\nid = \"Y\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n"
      "EC0Y_urad = 5\nu_EC0Y_urad = 1\n",
      "m");
  ASSERT_TRUE(parsed) << parsed.error().message;
  const Command at = {0.1, 0.1, 0, 0, 0, 0};
  for (const char* axis : {"X", "Y"}) {
    Machine m = *parsed;
    const auto frame = static_cast<std::size_t>(m.find(axis) - m.frames.data());
    m.sources.push_back(
        {"square", "urad", 10, SourceShape::normal, {{frame, 5, true, 1e-6, 0, 0}}});
    const auto model = budget_model(m, at, MachineApproach::mean, BudgetStage::measured);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->replaced, std::vector<std::string>{std::string("square on EC0") + axis});
    EXPECT_NEAR(budget_u_m(*model).norm(), 0.1e-6, 1e-12) << axis;  // 1 urad over 100 mm
    const auto rows = designed_against_measured(m, at);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_TRUE(rows[0].has_design);
    EXPECT_NEAR(rows[0].designed_u, 10e-6, 1e-12);
    // Without measured errors, the source acts.
    const auto designed = budget_model(m, at, MachineApproach::mean, BudgetStage::designed);
    EXPECT_NEAR(budget_u_m(*designed).norm(), 1e-6, 1e-12) << axis;
  }
}

}  // namespace
}  // namespace mdof::algo
