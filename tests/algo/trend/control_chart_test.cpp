#include "algo/trend/control_chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

std::vector<ChartValue> values(const std::vector<double>& x, double u = 0) {
  std::vector<ChartValue> out;
  for (const double v : x) out.push_back({v, u});
  return out;
}

// Flow rates of the NIST/SEMATECH handbook 6.3.2.2. The mean is 50.81, the mean moving range
// 1.8778; the limits 45.8155 and 55.8041 are calculated there as 50.81 ± 3 · 1.8778 / 1.128.
TEST(ControlChart, MatchesTheExampleOfTheHandbook) {
  const auto x = values({49.6, 47.6, 49.9, 51.3, 47.8, 51.2, 52.6, 52.4, 53.6, 52.1});
  const auto chart = control_chart(x, 10);
  ASSERT_TRUE(chart);
  EXPECT_NEAR(chart->centre, 50.81, 1e-12);
  EXPECT_NEAR(chart->sigma * 1.128, 1.8778, 5e-5);
  EXPECT_NEAR(chart->high[0], 55.8041, 1e-4);
  EXPECT_NEAR(chart->low[9], 45.8159, 1e-4);
  EXPECT_TRUE(chart->outside.empty());
  EXPECT_FALSE(chart->moved);
}

TEST(ControlChart, BaselineHasTheRequestedLength) {
  const auto x = values({1, 2, 1, 2, 1, 2, 30});
  EXPECT_EQ(control_chart(x)->baseline, 6U);
  EXPECT_EQ(control_chart(x, 4)->baseline, 4U);
  EXPECT_EQ(control_chart(x, 7)->baseline, 7U);
  EXPECT_FALSE(control_chart(x, 1));
  EXPECT_FALSE(control_chart(x, 3));
  EXPECT_FALSE(control_chart(x, 8));
  // The change from 0 to 9 is within the baseline. The move is reported at the value 90.
  const auto first = control_chart(values({0, 9, 9, 9, 9, 90}), 5);
  ASSERT_TRUE(first->moved);
  EXPECT_EQ(first->moved->since, 5U);
}

// Calculated by hand: 1 2 1 2 1 has the mean 1.4, moving ranges of 1 and sigma 1/1.128. The upper
// limit is 1.4 + 2.66; the value 4 is below it, 5 is above.
TEST(ControlChart, ComparesTheLastValueWithTheOthers) {
  EXPECT_FALSE(control_chart(values({1, 2, 1, 2, 1, 4}))->moved);
  const auto chart = control_chart(values({1, 2, 1, 2, 1, 5}));
  EXPECT_NEAR(chart->high[5], 1.4 + 3 / 1.128, 1e-12);
  EXPECT_EQ(chart->outside, std::vector<std::size_t>{5});
  ASSERT_TRUE(chart->moved);
  EXPECT_EQ(chart->moved->since, 5u);
  EXPECT_NEAR(chart->moved->by, 3.6, 1e-12);
  EXPECT_NEAR(chart->moved->u, std::sqrt(1.0 / 5 + 1) / 1.128, 1e-12);
  EXPECT_TRUE(control_chart(values({1, 2, 1, 2, 1, -3}))->moved->by < 0);
}

// Calculated by hand: the series 0 12 12 12 24 is divided into two parts. The sum of squares about
// the two means is 108 if the first or the last value is separate, and 168 for other divisions. The
// first of equal results is used.
TEST(ControlChart, ReportsTheFirstOfEqualSteps) {
  const auto chart = control_chart(values({0, 12, 12, 12, 24}), 4);
  ASSERT_TRUE(chart->moved);
  EXPECT_EQ(chart->moved->since, 1U);
  EXPECT_NEAR(chart->moved->by, 15, 1e-12);
}

TEST(ControlChart, LargeUncertaintyWidensTheLimits) {
  auto x = values({1, 2, 1, 2, 1, 5});
  x.back().u = 1.3;
  EXPECT_FALSE(control_chart(x)->moved);
  x.back().u = 1.1;
  ASSERT_TRUE(control_chart(x)->moved);
  EXPECT_NEAR(control_chart(x)->moved->u, 1.1, 1e-12);
}

TEST(ControlChart, ReportsEightValuesOnOneSide) {
  std::vector<double> x = {1, -1, 1, -1, 1, -1};  // sigma is 1.77
  for (int i = 0; i < 7; ++i) x.push_back(1.5);
  EXPECT_FALSE(control_chart(values(x), 6)->moved);
  x.push_back(1.5);
  const auto chart = control_chart(values(x), 6);
  EXPECT_TRUE(chart->outside.empty());
  EXPECT_EQ(chart->one_side, std::vector<std::size_t>{13});
  ASSERT_TRUE(chart->moved);
  EXPECT_EQ(chart->moved->since, 6u);
  EXPECT_NEAR(chart->moved->by, 1.5, 1e-12);
  x[9] = 0;  // on the centre, which belongs to neither side
  EXPECT_TRUE(control_chart(values(x), 6)->one_side.empty());
}

TEST(ControlChart, PastOutlierIsNoMove) {
  const auto chart = control_chart(values({1, 2, 1, 2, 9, 1, 2}), 4);
  EXPECT_EQ(chart->outside, std::vector<std::size_t>{4});
  EXPECT_FALSE(chart->moved);
}

TEST(ControlChart, NeedsEnoughValues) {
  EXPECT_FALSE(control_chart({}));
  EXPECT_FALSE(control_chart(values({1, 2, 1, 2})));
  EXPECT_TRUE(control_chart(values({1, 2, 1, 2, 1})));
  EXPECT_FALSE(control_chart(values({1, 2, 1, 2, 1}), 6));
  EXPECT_FALSE(control_chart(values({1, 2, 1, 2, 1}), 3));
}

// Four values and five values are on one side of the centre. The value between them equals the
// centre.
TEST(ControlChart, ValueOnTheCentreEndsARow) {
  std::vector<ChartValue> x(4, {5, 1});
  for (int i = 0; i < 12; ++i) x.push_back({i == 6 ? 5 : 5.5, 1});
  auto chart = control_chart(x, 4);
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->centre, 5);
  EXPECT_EQ(chart->sigma, 0);
  EXPECT_TRUE(chart->one_side.empty());
  x[10].value = 5.5;
  chart = control_chart(x, 4);
  EXPECT_EQ(chart->one_side, (std::vector<std::size_t>{11, 12, 13, 14, 15}));
  EXPECT_EQ(chart->low[3], 2);
  EXPECT_EQ(chart->high[3], 8);
}

}  // namespace
}  // namespace mdof::algo
