// Effects of the errors and sources of a machine along a path. Expected values are calculated by
// hand.
#include "algo/part/machine_causes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

using Field = std::vector<Eigen::Vector3d>;

// The axis X carries the tool, the axis Y the work. `machine`: further keys of the machine; `x` and
// `y`: keys of the axes; the sources follow `y`.
Result<Machine> xy_machine(const std::string& machine, const std::string& x, const std::string& y) {
  return parse_machine("name = \"m\"\nmachine = {chain = \"w-Y-b-X-t\"}\n" + machine + R"(
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
)" + x + R"(
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "standing"
)" + y,
                       "m.toml");
}

// Calculated by hand: X carries the tool, Y the table. The tool is above the reference point of the
// errors.
TEST(MachineCauses, MatchesManualCalculationOfLeversAndSources) {
  const auto machine = xy_machine("tool = {point_mm = [0, 0, 100]}", R"(
EXX_um = [[0, 0], [100, 4]]
EBX_urad = 10
u_EBX_urad = 2)",
                                  R"(EC0Y_urad = 25
u_EC0Y_urad = 1
[[source]]
name = "screw"
u = 0.5
unit = "um"
acts_on = [ { error = "EYY", factor = 2 }, { error = "EXX", factor = 9 } ])");
  ASSERT_TRUE(machine) << machine.error().message;
  const std::vector<Eigen::Vector3d> at = {{0, 0, 0}, {0.05, 0.04, 0}};
  const MachineCauses found = machine_causes(*machine, at);
  ASSERT_EQ(found.axes.size(), 3u);
  EXPECT_EQ(found.axes[0].name, "EC0Y");
  EXPECT_EQ(found.axes[1].name, "EXX");
  EXPECT_EQ(found.axes[2].name, "EBX");
  EXPECT_NEAR(found.axes[1].value_m[1](0), 2e-6, 1e-12);
  EXPECT_NEAR(found.axes[2].value_m[1](0), 10e-6 * 0.1, 1e-12);  // 10 urad with a lever of 100 mm
  EXPECT_NEAR(std::abs(found.axes[2].u_m[1](0)), 2e-6 * 0.1, 1e-12);
  EXPECT_NEAR(std::abs(found.axes[0].value_m[1](0)), 25e-6 * 0.04, 1e-12);
  // EXX is measured, so the source does not act on EXX.
  ASSERT_EQ(found.budget.size(), 1u);
  EXPECT_NEAR(std::abs(found.budget[0].u_m[1](1)), 1e-6, 1e-12);
  EXPECT_EQ(found.budget[0].u_m[1](0), 0);
}

// ECY is the rotation of the body of Y, EC0Y the rotation of its axis line. The effect of ECY is
// proportional to the X coordinate of the point, the effect of EC0Y to the travel of Y.
TEST(MachineCauses, SeparatesRotationOfBodyAndLine) {
  const auto machine = xy_machine("tool = {point_mm = [0, 0, 0]}", "", R"(ECY_urad = 10
u_ECY_urad = 2
EC0Y_urad = 25
u_EC0Y_urad = 3)");
  ASSERT_TRUE(machine) << machine.error().message;
  const MachineCauses found = machine_causes(*machine, {{0.05, 0, 0}, {0.05, 0.04, 0}});
  ASSERT_EQ(found.axes.size(), 2U);
  const PartCause &body = found.axes[0], &line = found.axes[1];
  EXPECT_EQ(body.name, "ECY");
  EXPECT_EQ(line.name, "EC0Y");
  for (const std::size_t p : {0U, 1U}) {
    EXPECT_NEAR(std::abs(body.value_m[p](1)), 10e-6 * 0.05, 1e-11);
    EXPECT_NEAR(std::abs(body.u_m[p](1)), 2e-6 * 0.05, 1e-11);
    EXPECT_NEAR(std::abs(line.value_m[p](0)), p == 0 ? 0 : 25e-6 * 0.04, 1e-11);
    EXPECT_NEAR(std::abs(line.u_m[p](0)), p == 0 ? 0 : 3e-6 * 0.04, 1e-11);
  }
}

// Calculated by hand. X is the axis of the table and moves in the direction + when its command
// increases. So the command +10 mm brings the tool to x = -10 mm of the part. There the table is 4
// um too far in the direction +X, so the tool is 4 um too far in the direction -X. Y moves the
// tool.
TEST(MachineCauses, PathIsInPartCoordinates) {
  for (const bool is_iso : {false, true}) {
    const auto machine = parse_machine(std::string(R"(name = "m"
machine = {chain = "w-X-b-Y-t", travel = { X = ")") +
                                           (is_iso ? "-" : "+") + R"(" }}
tool = {point_mm = [200, 0, 100]}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "standing"
EXX_um = [[-10, 0], [0, 0], [10, 4]]
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
EYY_um = [[-10, 0], [0, 0], [10, 3]]
[[source]]
name = "screw"
u = 0.5
unit = "um"
acts_on = [ { error = "EZX", factor = 1, factor_per_mm = 0.1, of = "X" } ]
)",
                                       "m.toml");
    ASSERT_TRUE(machine) << machine.error().message;
    const MachineCauses found = machine_causes(*machine, {{-0.01, 0.01, 0}, {0.01, -0.01, 0}});
    ASSERT_EQ(found.axes.size(), 2U);
    ASSERT_EQ(found.axes[0].name, "EXX");
    const std::size_t off = is_iso ? 1 : 0, right = 1 - off;
    EXPECT_NEAR(found.axes[0].value_m[off](0), -4e-6, 1e-15);
    EXPECT_EQ(found.axes[0].value_m[right](0), 0);
    EXPECT_NEAR(found.axes[1].value_m[0](1), 3e-6, 1e-15);
    EXPECT_EQ(found.axes[1].value_m[1](1), 0);
    // The factor is 1 + 0.1 / mm times the command: 2 at +10 mm, 0 at -10 mm.
    EXPECT_NEAR(std::abs(found.budget[0].u_m[off](2)), 1e-6, 1e-15);
    EXPECT_NEAR(found.budget[0].u_m[right](2), 0, 1e-15);
    EXPECT_TRUE(found.beyond.empty());  // the path ends exactly at the ends of the tables
  }
}

// X carries the tool. EXX is 0 forward and 10 um in reverse.
TEST(MachineCauses, PathGivesTheApproach) {
  const auto machine =
      xy_machine("", "EXX_um = [[0, 0, 10], [100, 0, 10]]", "EYY_um = [[0, 0, 4], [100, 0, 4]]");
  ASSERT_TRUE(machine) << machine.error().message;
  // X forward, Y in one direction while X does not move, X back.
  const Field path = {{0, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}, {0.1, 0.02, 0}, {0.05, 0.02, 0}};
  const MachineCauses found = machine_causes(*machine, path);
  ASSERT_EQ(found.axes.size(), 2u);
  const PartCause &EYY = found.axes[0], &EXX = found.axes[1];
  ASSERT_EQ(EXX.name, "EXX");
  const double expected_um[] = {0, 0, 0, 0, 10};
  for (std::size_t p = 0; p < path.size(); ++p)
    EXPECT_NEAR(EXX.value_m[p](0) * 1e6, expected_um[p], 1e-9) << p;
  // Y carries the work with travel +, so its command decreases along the path.
  EXPECT_NEAR(std::abs(EYY.value_m[2](1)) * 1e6, 2, 1e-9);
  EXPECT_NEAR(std::abs(EYY.value_m[4](1)) * 1e6, 4, 1e-9);
  EXPECT_EQ(found.unknown_approach, (std::vector<std::pair<std::string, std::size_t>>{{"Y", 3}}));
}

// EC0X and EC0Y are one angle, so the measured EC0Y contains the effect of the source on EC0X.
TEST(MachineCauses, MeasuredSquarenessContainsItsSource) {
  const auto machine = xy_machine("", "", R"(EC0Y_urad = 20
[[source]]
name = "guide"
u = 30
unit = "urad"
acts_on = [ { error = "EC0X", factor = 1 } ])");
  ASSERT_TRUE(machine) << machine.error().message;
  const Field path = {{0.1, 0.1, 0}};
  EXPECT_EQ(machine_causes(*machine, path).budget[0].u_m[0].norm(), 0);
  EXPECT_NEAR(machine_causes(*machine, path, false).budget[0].u_m[0].norm(), 3e-6, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
