// Place of the largest error, and approaches of the axes along the path. Expected values are
// calculated by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/part/machine_causes.h"

namespace mdof::algo {
namespace {

using Field = std::vector<Eigen::Vector3d>;

// A source acts on an angle. The error is its random number times the lever arm, so it is largest
// at the end of the path in every trial.
TEST(PartPlaces, LargestErrorOfABudgetIsAtTheLongestArm) {
  PartPath path;
  PartCause source = new_cause("source", 101);
  for (std::size_t k = 0; k <= 100; ++k) {
    path.at_m.emplace_back(1e-3 * static_cast<double>(k), 0, 0);
    source.u_m[k] = {5e-6 * (0.05 + path.at_m[k](0)), 0, 5e-6 * 0.1};
  }
  EXPECT_EQ(part_error(path, {source}, 1).worst, 100u);
  // A measured cause that is largest at the other end, with a small u.
  PartCause measured = new_cause("measured", 101);
  for (std::size_t k = 0; k <= 100; ++k)
    measured.value_m[k] = {2e-6 * (1 - 0.01 * static_cast<double>(k)), 0, 0};
  EXPECT_EQ(part_error(path, {source, measured}, 1).worst, 0u);
  path.normal.assign(101, {0, 0, 1});  // the measured error is perpendicular to the normals
  for (std::size_t k = 0; k <= 100; ++k) source.u_m[k](2) = k == 40 ? 2e-6 : 1e-6;
  EXPECT_EQ(part_error(path, {source, measured}, 1).worst, 40u);
}

// X carries the tool. EXX is 0 forward and 10 um in reverse.
TEST(PartPlaces, PathGivesTheApproach) {
  const auto machine = parse_machine(R"(name = "m"
machine = {chain = "w-Y-b-X-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
EXX_um = [[0, 0, 10], [100, 0, 10]]
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "standing"
EYY_um = [[0, 0, 4], [100, 0, 4]]
)",
                                     "m.toml");
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
TEST(PartPlaces, MeasuredSquarenessContainsItsSource) {
  const auto machine = parse_machine(R"(name = "m"
machine = {chain = "w-Y-b-X-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "standing"
EC0Y_urad = 20
[[source]]
name = "guide"
u = 30
unit = "urad"
acts_on = [ { error = "EC0X", factor = 1 } ]
)",
                                     "m.toml");
  ASSERT_TRUE(machine) << machine.error().message;
  const Field path = {{0.1, 0.1, 0}};
  EXPECT_EQ(machine_causes(*machine, path).budget[0].u_m[0].norm(), 0);
  EXPECT_NEAR(machine_causes(*machine, path, false).budget[0].u_m[0].norm(), 3e-6, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
