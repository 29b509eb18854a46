// Coverage factors and effective degrees of freedom, compared with values from GUM annex G.
#include "algo/uncertainty/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mdof::algo {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// GUM table G.2, column 95 %.
TEST(Coverage, MatchesTheGuide) {
  const std::pair<double, double> table[] = {
      {1, 12.71}, {2, 4.30},  {3, 3.18},  {4, 2.78},  {5, 2.57},  {6, 2.45},   {8, 2.31},
      {10, 2.23}, {15, 2.13}, {20, 2.09}, {30, 2.04}, {50, 2.01}, {100, 1.984}};
  for (const auto& [freedom, k] : table)
    EXPECT_NEAR(coverage_factor(freedom), k, freedom == 100 ? 0.0005 : 0.005) << freedom;
  EXPECT_NEAR(coverage_factor(kInfinite), 1.959964, 1e-6);
  EXPECT_NEAR(coverage_factor(1e6), 1.959964, 1e-5);
  EXPECT_NEAR(coverage_factor(2.5), 3.574655, 1e-6);    // scipy.stats.t.ppf(0.975, 2.5)
  EXPECT_NEAR(coverage_factor(0.5), 164.557673, 1e-5);  // series of the incomplete beta function
}

// The coverage factor is calculated by one method below 200 degrees of freedom and by another from
// 200 on. At 200 both agree with each other and with scipy.stats.t.ppf(0.975, 200).
TEST(Coverage, FactorsForFewAndManyDegreesMeetAt200) {
  const double below = coverage_factor(200 - 1e-6), above = coverage_factor(200);
  EXPECT_NEAR(below, above, 3e-8);
  EXPECT_NEAR(above, 1.971896, 1e-6);
}

// Reference: the root of the regularized incomplete beta function with 30 digits, by mpmath.
TEST(Coverage, QuantilesOfStudentToTwelveDigits) {
  struct Quantiles {
    double freedom, two_sided, one_sided;
  };
  const Quantiles table[] = {
      {1, 12.7062047361747, 6.313751514675043},     {1.5, 6.016663104427932, 3.705180820096752},
      {2, 4.302652729749464, 2.919985580353726},    {2.5, 3.574654842003683, 2.558218614135937},
      {4, 2.776445105197794, 2.13184678632665},     {9.3, 2.251082224684441, 1.826403427771457},
      {57.5, 2.002088151979508, 1.671788721670813}, {199, 1.971956544251754, 1.652546746166563}};
  for (const Quantiles& q : table) {
    EXPECT_NEAR(coverage_factor(q.freedom) / q.two_sided, 1, 1e-12) << q.freedom;
    EXPECT_NEAR(one_sided_factor(q.freedom) / q.one_sided, 1, 1e-12) << q.freedom;
  }
  // Calculated by the series expansion; its fourth term is below 1 / 200^4.
  const Quantiles many[] = {{200, 1.971896223633909, 1.652508100910878},
                            {250, 1.969498393421154, 1.650971489812858},
                            {1000, 1.962339080826408, 1.646378817285465},
                            {9e6, 1.959964248125781, 1.644853796259173}};
  for (const Quantiles& q : many) {
    EXPECT_NEAR(coverage_factor(q.freedom), q.two_sided, 3e-9) << q.freedom;
    EXPECT_NEAR(one_sided_factor(q.freedom), q.one_sided, 3e-9) << q.freedom;
  }
}

// GUM H.1.6, end gauge calibration: the guide truncates 16.7 to 16.
TEST(Coverage, EffectiveDegreesOfFreedomOfTheGaugeBlock) {
  const std::vector<UncertaintyPart> parts = {{25, 18}, {9.7, 25.6}, {2.9, 50}, {16.6, 2}};
  const double freedom = effective_freedom(parts);
  EXPECT_EQ(std::floor(freedom), 16);
}

// GUM G.4.2: if parts have equal u and equal degrees of freedom, their degrees of freedom add.
TEST(Coverage, EqualPartsAddTheirFreedom) {
  EXPECT_NEAR(effective_freedom(std::vector<UncertaintyPart>{{3, 5}, {3, 5}}), 10, 1e-12);
  EXPECT_EQ(effective_freedom(std::vector<UncertaintyPart>{{3, kInfinite}, {3, kInfinite}}),
            kInfinite);
  EXPECT_EQ(effective_freedom(std::vector<UncertaintyPart>{}), kInfinite);
  EXPECT_EQ(effective_freedom(std::vector<UncertaintyPart>{{1, kInfinite}, {1e-14, 10}}), kInfinite)
      << "not 1e57";
}

// Reference: scipy.stats.t.ppf(0.95, ν).
TEST(Coverage, OneSidedFactorMatchesScipy) {
  const std::pair<double, double> table[] = {{1, 6.313752},   {2, 2.919986},        {5, 2.015048},
                                             {30, 1.697261},  {199, 1.652547},      {200, 1.652508},
                                             {1e6, 1.644855}, {kInfinite, 1.644854}};
  for (const auto& [freedom, t] : table) EXPECT_NEAR(one_sided_factor(freedom), t, 2e-6) << freedom;
}

}  // namespace
}  // namespace mdof::algo
