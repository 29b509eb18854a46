#include <gtest/gtest.h>

#include <cmath>

#include "algo/compensation/compensation.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

// A table with EYX at 0, 10 and 40 mm; the other errors are 0.
CompensationTable table_by_hand() {
  CompensationTable table;
  table.position_m = {0, 10e-3, 40e-3};
  for (auto* columns : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    columns->fill({0, 0, 0});
  table.forward[0] = {1e-6, 3e-6, -3e-6};
  table.reverse[0] = {2e-6, 5e-6, 1e-6};
  table.u_forward[0] = {3e-9, 3e-9, 3e-9};
  table.u_reverse[0] = {4e-9, 4e-9, 4e-9};
  return table;
}

TEST(TableAt, IsLinearBetweenTargetsAndConstantOutside) {
  const CompensationTable table = table_by_hand();
  struct Case {
    double at_m, forward, reverse;
    bool inside;
  };
  for (const Case& c : {Case{-1e-3, 1e-6, 2e-6, false}, Case{0, 1e-6, 2e-6, true},
                        Case{2.5e-3, 1.5e-6, 2.75e-6, true}, Case{10e-3, 3e-6, 5e-6, true},
                        Case{20e-3, 1e-6, 11e-6 / 3, true}, Case{40e-3, -3e-6, 1e-6, true},
                        Case{41e-3, -3e-6, 1e-6, false}}) {
    const TableValue f = table_at(table, c.at_m, TableSide::forward);
    const TableValue r = table_at(table, c.at_m, TableSide::reverse);
    const TableValue mean = table_at(table, c.at_m, TableSide::mean);
    EXPECT_NEAR(f.error[0], c.forward, 1e-18) << c.at_m;
    EXPECT_NEAR(r.error[0], c.reverse, 1e-18) << c.at_m;
    EXPECT_NEAR(mean.error[0], (c.forward + c.reverse) / 2, 1e-18) << c.at_m;
    for (const TableValue& value : {f, r, mean}) EXPECT_EQ(value.inside, c.inside) << c.at_m;
  }
}

// At the last target, and at the next floating-point number on either side, the last value applies.
TEST(TableAt, GivesTheValueOfTheLastTarget) {
  const CompensationTable table = table_by_hand();
  const double last_m = table.position_m.back();
  for (const double at_m : {std::nextafter(last_m, 0.0), last_m, std::nextafter(last_m, 1.0)})
    EXPECT_NEAR(table_at(table, at_m, TableSide::forward).error[0], -3e-6, 1e-15);
  EXPECT_EQ(table_at(table, last_m, TableSide::forward).error[0], -3e-6);
  EXPECT_EQ(table_at(table, 0, TableSide::forward).error[0], 1e-6);
}

TEST(TableAt, NoRunsGiveNoNoticesOfUnevenVisits) {
  const auto uneven = uneven_visit_notices({});
  ASSERT_TRUE(uneven);
  EXPECT_TRUE(uneven->empty());
}

TEST(TableAt, MissingValueIsBridgedByItsNeighbours) {
  CompensationTable table = table_by_hand();
  table.position_m = {0, 10e-3, 20e-3, 40e-3};
  for (auto* columns : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    columns->fill({0, 0, 0, 0});
  table.forward[0] = {kNaN, 2e-6, kNaN, 8e-6};
  for (const auto& [at_m, expected] : {std::pair(5e-3, 2e-6),
                                       {10e-3, 2e-6},
                                       {15e-3, 3e-6},
                                       {20e-3, 4e-6},
                                       {30e-3, 6e-6},
                                       {40e-3, 8e-6}})
    EXPECT_NEAR(table_at(table, at_m, TableSide::forward).error[0], expected, 1e-18) << at_m;
  EXPECT_FALSE(table_at(table, 5e-3, TableSide::forward).inside);
  EXPECT_TRUE(table_at(table, 15e-3, TableSide::forward).inside);
  table.forward[0].assign(4, kNaN);  // the values of the other approach are used; inside = false
  EXPECT_EQ(table_at(table, 15e-3, TableSide::mean).error[0], 0);
  EXPECT_FALSE(table_at(table, 15e-3, TableSide::mean).inside);
  table.forward[0] = {1e-6, kNaN, kNaN, kNaN};
  EXPECT_NEAR(table_at(table, 15e-3, TableSide::forward).error[0], 1e-6, 1e-18);
}

TEST(TableAt, SingleTargetIsConstantEverywhere) {
  CompensationTable table;
  table.position_m = {10e-3};
  for (auto* columns : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    columns->fill({2e-6});
  for (const double at_m : {0.0, 10e-3, 20e-3})
    EXPECT_EQ(table_at(table, at_m, TableSide::forward).error[0], 2e-6);
}

CompensationTable table_with_u() {
  CompensationTable table = table_by_hand();
  for (auto& column : table.u_declared) column = {5e-9, 2e-9, 7e-9};
  table.u_forward[1] = {8e-9, 0, 3e-9};
  return table;
}

// u is linear between targets for the declared part and for the random part. The error is 0
// everywhere, so the interpolation adds nothing. If the larger u of the two targets applied, u
// would jump beside a target.
TEST(TableAt, UIsLinearBetweenTargets) {
  const CompensationTable table = table_with_u();
  ASSERT_TRUE(table.has_declared());
  struct Case {
    double at_m, declared, random;
  };
  for (const Case& c : {Case{-50e-3, 5e-9, 8e-9}, Case{0, 5e-9, 8e-9}, Case{1e-3, 4.7e-9, 7.2e-9},
                        Case{9e-3, 2.3e-9, 0.8e-9}, Case{10e-3, 2e-9, 0}, Case{16e-3, 3e-9, 0.6e-9},
                        Case{40e-3, 7e-9, 3e-9}, Case{50e-3, 7e-9, 3e-9}}) {
    const TableValue value = table_at(table, c.at_m, TableSide::forward);
    EXPECT_EQ(value.u_interpolation[1], 0) << c.at_m;
    EXPECT_NEAR(value.u[1], std::hypot(c.declared, c.random), 1e-21) << c.at_m;
  }
}

TEST(TableAt, UIsContinuousAtTargets) {
  const CompensationTable table = table_with_u();
  for (const double target_m : table.position_m)
    for (const double small_offset_m : {-1e-9, 1e-9})
      EXPECT_NEAR(table_at(table, target_m + small_offset_m, TableSide::forward).u[1],
                  table_at(table, target_m, TableSide::forward).u[1], 1e-14)
          << target_m;
}

// The errors of the axis are a straight line, but a table holds its end values. A position within
// 2 % of the end interval beyond an end counts as measured there.
TEST(TableAt, UBeyondAnEndContainsTheSlope) {
  CompensationTable table = table_with_u();
  table.forward[0] = {1e-6, 2e-6, 5e-6};
  for (const auto& [at_m, off_m] :
       {std::pair(-0.2e-3, 0.02e-6), {0.0, 0.0}, {40e-3, 0.0}, {40.6e-3, 0.06e-6}}) {
    const TableValue value = table_at(table, at_m, TableSide::forward);
    EXPECT_TRUE(value.inside) << at_m;
    EXPECT_NEAR(value.u_interpolation[0], off_m, 1e-15) << at_m;
    EXPECT_NEAR(
        value.u[0],
        std::hypot(off_m, table_at(table, at_m < 1e-3 ? 0 : 40e-3, TableSide::forward).u[0]),
        1e-15);
  }
  table.forward[0] = {kNaN, 2e-6, 5e-6};
  EXPECT_NEAR(table_at(table, 9e-3, TableSide::forward).u_interpolation[0], 0.1e-6, 1e-15);
  // A parabola is below its tangent and above the extended chord.
  table.position_m = {0, 10e-3, 20e-3};
  table.forward[0] = {0, 1e-6, 4e-6};                                      // x²/100 m
  const double chord = 0.02e-6, bent = 0.5 * 0.2e-3 * 10.2e-3 * 4 * 0.02;  // R = 4
  EXPECT_NEAR(table_at(table, -0.2e-3, TableSide::forward).u_interpolation[0],
              std::hypot(chord, bent), 1e-12);  // the noise is subtracted
}

// Each visit has the variance v. An angle is the mean of one approach minus the mean of both
// approaches at the first target. The mean of both approaches then has the variance v, and it is
// exactly 0 at the first target (GUM 5.2.2).
TEST(TableAt, MeanOfAnglesContainsTheirCommonReference) {
  CompensationTable table = table_by_hand();
  const double v = 4e-16;
  for (auto* u : {&table.u_forward, &table.u_reverse})
    (*u)[2] = {std::sqrt(v / 2), std::sqrt(1.5 * v), std::sqrt(1.5 * v)};
  for (const auto& [at_m, variance] : {std::pair(0.0, 0.0), {10e-3, v}, {25e-3, v}, {40e-3, v}})
    EXPECT_NEAR(table_at(table, at_m, TableSide::mean).u[2], std::sqrt(variance), 1e-15) << at_m;
}

// Variance of (1 - s) a + s b by GUM 5.2.2.
TEST(TableAt, UIsSufficientForAnyCorrelation) {
  CompensationTable table = table_with_u();
  for (auto& column : table.u_declared) column.clear();
  const double a = table.u_forward[1][1] = 2e-9, b = table.u_forward[1][2];
  for (const double s : {0.001, 0.2, 0.5, 0.9})
    for (const double correlation : {-1.0, 0.0, 0.7, 1.0}) {
      const double variance =
          std::pow((1 - s) * a, 2) + std::pow(s * b, 2) + 2 * correlation * s * (1 - s) * a * b;
      const double u = table_at(table, 10e-3 + s * 30e-3, TableSide::forward).u[1];
      EXPECT_GE(u, std::sqrt(variance) - 1e-21) << s << " " << correlation;
      if (correlation == 1) {
        EXPECT_NEAR(u, std::sqrt(variance), 1e-21) << s;
      }
    }
}

// At a target, u is that of the target, also if the target beside it has no declared u.
TEST(TableAt, UAtATargetDoesNotDependOnTheTargetsBeside) {
  CompensationTable table = table_with_u();
  table.u_declared[1] = {5e-9, kNaN, 7e-9};
  EXPECT_NEAR(table_at(table, 40e-3, TableSide::forward).u[1], std::hypot(7e-9, 3e-9), 1e-21);
  EXPECT_NEAR(table_at(table, 0, TableSide::forward).u[1], std::hypot(5e-9, 8e-9), 1e-21);
  EXPECT_TRUE(std::isnan(table_at(table, 20e-3, TableSide::forward).u[1]));
}

}  // namespace
}  // namespace mdof::algo
