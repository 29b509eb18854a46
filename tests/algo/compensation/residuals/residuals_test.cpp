// The sum of residuals and of the table that the controller applied, by hand.
#include "algo/compensation/residuals/residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/sample.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

enum ResidualError { kStraightY, kStraightZ, kRoll, kPitch, kYaw };

// X and Y move the work, Z moves the tool: EYX and EZX can be corrected. No axis corrects an angle.
CompensationTable table_of_x(std::int64_t id, const std::vector<double>& position_mm) {
  CompensationTable table;
  table.id = id;
  table.machine = parse_chain("w-X-Y-b-Z-t").value();
  table.slope_removed = false;
  for (const double x : position_mm) table.position_m.push_back(1e-3 * x);
  for (auto* columns : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    columns->fill(std::vector<double>(position_mm.size(), 0.0));
  return table;
}

CompensationTable applied_table() {
  CompensationTable table = table_of_x(7, {5, 15, 45, 50});
  table.forward[kStraightY] = {1e-6, 3e-6, -3e-6, 2e-6};
  table.reverse[kStraightY] = {2e-6, 4e-6, 1e-6, -1e-6};
  table.forward[kStraightZ] = {-5e-6, 0, 3e-6, 1e-6};
  table.forward[kYaw] = {70e-6, 80e-6, 90e-6, 95e-6};
  return table;
}

// The targets of the applied table, and 30 mm between two of them.
CompensationTable residual_table() {
  CompensationTable table = table_of_x(0, {5, 15, 30, 45, 50});
  table.forward[kStraightY] = {0.1e-6, 0.2e-6, 0.3e-6, 0.4e-6, 0.5e-6};
  table.reverse[kStraightY] = {-0.1e-6, 0.2e-6, -0.3e-6, 0.4e-6, -0.5e-6};
  table.forward[kYaw] = {5e-6, 6e-6, 7e-6, 8e-6, 9e-6};
  table.reverse[kYaw] = {7e-6, 8e-6, 9e-6, 10e-6, 11e-6};
  return table;
}

void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-17) << i;
}

// Halfway between 15 and 45 mm, the applied values are the means of their neighbours. Angles remain
// as measured. They are relative to their mean at the first target, 6 µrad.
TEST(ResidualsByHand, AddToTheAppliedValues) {
  CompensationTable table = residual_table();
  const Status added = add_applied(applied_table(), table);
  ASSERT_TRUE(added) << added.error().message;
  expect_values(table.forward[kStraightY], {1.1e-6, 3.2e-6, 0.3e-6, -2.6e-6, 2.5e-6});
  expect_values(table.reverse[kStraightY], {1.9e-6, 4.2e-6, 2.2e-6, 1.4e-6, -1.5e-6});
  expect_values(table.forward[kStraightZ], {-5e-6, 0, 1.5e-6, 3e-6, 1e-6});
  expect_values(table.reverse[kStraightZ], {0, 0, 0, 0, 0});
  expect_values(table.forward[kYaw], {-1e-6, 0, 1e-6, 2e-6, 3e-6});
  expect_values(table.reverse[kYaw], {1e-6, 2e-6, 3e-6, 4e-6, 5e-6});
  expect_values(table.forward[kRoll], {0, 0, 0, 0, 0});
  EXPECT_EQ(table.added_to, 7);
}

// The sum refers to the least-squares line of its means. A target with one approach has the mean of
// this approach; a target without values has none.
TEST(ResidualsByHand, ReferToTheLineOfTheSum) {
  CompensationTable applied = table_of_x(7, {0, 10, 20, 40}),
                    table = table_of_x(0, {0, 10, 20, 40});
  table.slope_removed = applied.slope_removed = true;
  applied.forward[kStraightY] = {1e-6, 0, 4e-6, 2e-6};
  applied.reverse[kStraightY] = {3e-6, 2e-6, 0, 6e-6};
  table.forward[kStraightY] = {1e-6, 3e-6, kNaN, kNaN};
  table.reverse[kStraightY] = {-1e-6, kNaN, kNaN, 2e-6};
  table.forward[kYaw] = {kNaN, 4e-6, 6e-6, 7e-6};
  table.reverse[kYaw] = {kNaN, 8e-6, 6e-6, 7e-6};
  ASSERT_TRUE(add_applied(applied, table));
  // The sums are 2, 3 and - forward, 2, -, - and 8 reverse. The means (2, 3, 8) at 0, 10 and 40 mm
  // have the middle 50/3 mm and 13/3 µm, and the slope Σ xy / Σ xx = (350 - 3 (50/3) (13/3)) /
  // (1700
  // - 2500/3) = 0.153846 µm/mm.
  const double slope = (350 - 650.0 / 3) / (1700 - 2500.0 / 3), at_0 = 13.0 / 3 - slope * 50 / 3;
  const auto left = [&](double sum_um, double x_mm) {
    return 1e-6 * (sum_um - at_0 - slope * x_mm);
  };
  EXPECT_NEAR(table.forward[kStraightY][0], left(2, 0), 1e-17);
  EXPECT_NEAR(table.forward[kStraightY][1], left(3, 10), 1e-17);
  EXPECT_NEAR(table.reverse[kStraightY][0], left(2, 0), 1e-17);
  EXPECT_NEAR(table.reverse[kStraightY][3], left(8, 40), 1e-17);
  EXPECT_TRUE(std::isnan(table.forward[kStraightY][2]) && std::isnan(table.reverse[kStraightY][2]));
  // The first target with an angle is the second one, with the mean 6 µrad.
  EXPECT_NEAR(table.forward[kYaw][1], -2e-6, 1e-17);
  EXPECT_NEAR(table.reverse[kYaw][1], 2e-6, 1e-17);
  EXPECT_NEAR(table.forward[kYaw][3], 1e-6, 1e-17);
}

TEST(ResidualsByHand, AreSimulatedIfOneTableIs) {
  for (const bool of_applied : {false, true})
    for (const bool of_table : {false, true}) {
      CompensationTable applied = applied_table(), table = residual_table();
      applied.simulated = of_applied;
      table.simulated = of_table;
      ASSERT_TRUE(add_applied(applied, table));
      EXPECT_EQ(table.simulated, of_applied || of_table);
    }
}

std::string refusal_of_sum(const CompensationTable& applied, CompensationTable table) {
  const Status added = add_applied(applied, table);
  return added ? "" : added.error().message;
}

// A target of the runs may be up to 2 % of the smaller interval beside a target of the table: 0.2,
// 0.2, 0.1 and 0.1 mm.
TEST(ResidualsByHand, NeedEachTargetOfTheTable) {
  const std::size_t rows[] = {0, 1, 3, 4};
  const double window_mm[] = {0.2, 0.2, 0.1, 0.1};
  const char* at_mm[] = {"5", "15", "45", "50"};
  for (std::size_t i = 0; i < 4; ++i)
    for (const double share : {-1.1, -0.9, 0.9, 1.1}) {
      CompensationTable table = residual_table();
      table.position_m[rows[i]] += 1e-3 * share * window_mm[i];
      const std::string said = refusal_of_sum(applied_table(), table);
      EXPECT_EQ(said.empty(), std::abs(share) < 1) << i << " " << share << " " << said;
      if (said.empty()) continue;
      EXPECT_NE(said.find(std::string("position ") + at_mm[i] + " mm"), std::string::npos) << said;
      EXPECT_NE(said.find("table 7"), std::string::npos) << said;
    }
  const std::string beyond = refusal_of_sum(applied_table(), table_of_x(0, {5, 15, 45, 50, 60}));
  EXPECT_NE(beyond.find("target at 60 mm, beyond the values of table 7"), std::string::npos)
      << beyond;
}

TEST(ResidualsByHand, NeedTheSetUpOfTheTable) {
  const auto says = [](const std::function<void(CompensationTable&)>& change_applied,
                       const std::string& expected) {
    CompensationTable applied = applied_table();
    change_applied(applied);
    const std::string said = refusal_of_sum(applied, residual_table());
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  };
  says([](auto& t) { t.axis = Axis::z; }, "table 7 is for axis Z, but the runs measure axis X");
  says([](auto& t) { t.positioning.forward = {0, 0, 0, 0}; }, "contains positioning errors");
  says([](auto& t) { t.sides.against_encoder = true; }, "differ in at least one of moves, travel");
  says([](auto& t) { t.machine = {}; }, "differ in at least one of");
  says([](auto& t) { t.stated = kAtCarriage; }, "differ in at least one of");
  const auto missing = [](auto& columns) {
    for (auto& column : columns) column.assign(column.size(), kNaN);
  };
  says([&](auto& t) { missing(t.reverse); }, "the reverse approach is missing in table 7");
  CompensationTable one_way = residual_table();
  missing(one_way.forward);
  EXPECT_NE(
      refusal_of_sum(applied_table(), one_way).find("the forward approach is missing in the runs"),
      std::string::npos);
  CompensationTable unknown = applied_table(), of_runs = residual_table();
  unknown.machine = of_runs.machine = {};
  EXPECT_NE(refusal_of_sum(unknown, of_runs).find("table 7 gives no correction"),
            std::string::npos);
}

// Both approaches have the applied values 1, -1, 1, -1 µm, and the residuals `left_um` times these
// values. `u_um`: u of each value of the sum.
std::string notices_of_sum(double left_um, double u_um) {
  CompensationTable applied = table_of_x(7, {0, 10, 20, 30});
  applied.forward[kStraightZ] = applied.reverse[kStraightZ] = {1e-6, -1e-6, 1e-6, -1e-6};
  applied.forward[kYaw] = {1e-6, -1e-6, 1e-6, -1e-6};
  CompensationTable sum = applied;
  sum.id = 0;
  for (auto* side : {&sum.forward, &sum.reverse})
    for (std::size_t i = 0; i < 4; ++i) {
      (*side)[kStraightZ][i] *= 1 + left_um;
      (*side)[kYaw][i] *= 1 + left_um;
    }
  for (auto* u : {&sum.u_forward, &sum.u_reverse}) (*u)[kStraightZ].assign(4, 1e-6 * u_um);
  return test::shown(residual_notices(applied, nullptr, sum));
}

// Residuals are similar to the applied values from 0.75 times on, if the values exceed 4 u. Angles
// are not compared, because the controller cannot correct them.
TEST(ResidualNoticesByHand, StateTheShareThatRemained) {
  EXPECT_EQ(notices_of_sum(0.74, 0), "");
  EXPECT_EQ(notices_of_sum(0.76, 0), "residuals_like_table EZX part=errors percent=76 table=7\n");
  EXPECT_EQ(notices_of_sum(-0.74, 0), "");
  EXPECT_EQ(notices_of_sum(-0.76, 0), "residuals_like_table EZX part=errors percent=-76 table=7\n");
  EXPECT_EQ(notices_of_sum(2, 0.24), "residuals_like_table EZX part=errors percent=200 table=7\n");
  EXPECT_EQ(notices_of_sum(2, 0.26), "");
}

// The applied values m ± h: m is 10 times h. If only the mean is applied, ± h remains.
TEST(ResidualNoticesByHand, CompareReversalErrorsSeparately) {
  CompensationTable applied = table_of_x(7, {0, 10, 20, 30});
  applied.forward[kStraightY] = {11e-6, -9e-6, 11e-6, -9e-6};
  applied.reverse[kStraightY] = {9e-6, -11e-6, 9e-6, -11e-6};
  CompensationTable sum = applied;
  for (std::size_t i = 0; i < 4; ++i) {
    sum.forward[kStraightY][i] += 0.9e-6;
    sum.reverse[kStraightY][i] -= 0.9e-6;
  }
  const auto said = [&] { return test::shown(residual_notices(applied, nullptr, sum)); };
  EXPECT_EQ(said(), "residuals_like_table EYX part=reversal errors percent=90 table=7\n");
  // u of the difference is √2 times u of the values: 2 µm must exceed 4 √2 u.
  for (const auto& [u, is_said] : {std::pair(0.35e-6, true), {0.36e-6, false}}) {
    for (auto* column : {&sum.u_forward, &sum.u_reverse}) (*column)[kStraightY].assign(4, u);
    EXPECT_EQ(!said().empty(), is_said) << u;
  }
  // Values that are missing in one approach are not compared.
  for (auto* column : {&sum.u_forward, &sum.u_reverse}) (*column)[kStraightY].assign(4, 0);
  sum.reverse[kStraightY].assign(4, kNaN);
  EXPECT_EQ(said(), "");
}

// The second table was added to the first one, but the controller applied neither: the residuals
// are half of the sum, and equal to what was added.
TEST(ResidualNoticesByHand, CompareTheAddedErrors) {
  CompensationTable earlier = table_of_x(6, {0, 10, 20, 30}), applied = earlier, sum = earlier;
  applied.id = 7;
  earlier.forward[kStraightY] = earlier.reverse[kStraightY] = {1e-6, -1e-6, 1e-6, -1e-6};
  applied.forward[kStraightY] = applied.reverse[kStraightY] = {2e-6, -2e-6, 2e-6, -2e-6};
  sum.forward[kStraightY] = sum.reverse[kStraightY] = {3e-6, -3e-6, 3e-6, -3e-6};
  EXPECT_EQ(residual_notices(applied, nullptr, sum).size(), 0u);
  EXPECT_EQ(test::shown(residual_notices(applied, &earlier, sum)),
            "residuals_like_table EYX part=added errors percent=100 table=7\n");
}

// The first table is ± 100 with a reversal of ± 50, the second adds ± 10 with a reversal of ± 1,
// which the controller does not apply.
TEST(ResidualNoticesByHand, CompareTheAddedReversalErrors) {
  CompensationTable earlier = table_of_x(6, {0, 10, 20, 30}), applied = earlier, sum = earlier;
  applied.id = 7;
  for (std::size_t i = 0; i < 4; ++i) {
    const double wave = i % 2 == 0 ? 1e-6 : -1e-6, way = 1e-6;
    earlier.forward[kStraightY][i] = 100 * wave + 50 * way;
    earlier.reverse[kStraightY][i] = 100 * wave - 50 * way;
    applied.forward[kStraightY][i] = 110 * wave + 51 * way;
    applied.reverse[kStraightY][i] = 110 * wave - 51 * way;
    sum.forward[kStraightY][i] = 110 * wave + 52 * way;
    sum.reverse[kStraightY][i] = 110 * wave - 52 * way;
  }
  EXPECT_EQ(residual_notices(applied, nullptr, sum).size(), 0u);
  EXPECT_EQ(test::shown(residual_notices(applied, &earlier, sum)),
            "residuals_like_table EYX part=added reversal errors percent=100 table=7\n");
}

}  // namespace
}  // namespace mdof::algo
