// GUM annex G: values that the guide prints.
#include "algo/uncertainty/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mdof::algo {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Table G.2, column 95 %.
TEST(Coverage, FactorsOfTheGuide) {
  const std::pair<double, double> table[] = {
      {1, 12.71}, {2, 4.30},  {3, 3.18},  {4, 2.78},  {5, 2.57},  {6, 2.45},   {8, 2.31},
      {10, 2.23}, {15, 2.13}, {20, 2.09}, {30, 2.04}, {50, 2.01}, {100, 1.984}};
  for (const auto& [freedom, k] : table)
    EXPECT_NEAR(coverage_factor(freedom), k, freedom == 100 ? 0.0005 : 0.005) << freedom;
  EXPECT_NEAR(coverage_factor(kInfinite), 1.959964, 1e-6);
  EXPECT_NEAR(coverage_factor(1e6), 1.959964, 1e-5);
  EXPECT_NEAR(coverage_factor(2.5), 3.574655, 1e-6);  // scipy.stats.t.ppf(0.975, 2.5)
}

// Two ways to one number where they meet, and another program's: scipy.stats.t.ppf(0.975, 200).
TEST(Coverage, FewAndManyDegreesOfFreedomMeet) {
  const double below = coverage_factor(200 - 1e-6), above = coverage_factor(200);
  EXPECT_NEAR(below, above, 3e-8);
  EXPECT_NEAR(above, 1.971896, 1e-6);
}

// H.1.6: end gauge calibration; the guide comes to 16 after cutting 16.7.
TEST(Coverage, EffectiveDegreesOfFreedomOfTheGaugeBlock) {
  const std::vector<UncertaintyPart> parts = {{25, 18}, {9.7, 25.6}, {2.9, 50}, {16.6, 2}};
  const double freedom = effective_freedom(parts);
  EXPECT_EQ(std::floor(freedom), 16);
}

// G.4.2: equal parts of equal freedom add their freedoms.
TEST(Coverage, EqualPartsAddTheirFreedom) {
  EXPECT_NEAR(effective_freedom(std::vector<UncertaintyPart>{{3, 5}, {3, 5}}), 10, 1e-12);
  EXPECT_EQ(effective_freedom(std::vector<UncertaintyPart>{{3, kInfinite}, {3, kInfinite}}),
            kInfinite);
  EXPECT_EQ(effective_freedom(std::vector<UncertaintyPart>{}), kInfinite);
}

// scipy.stats.t.ppf(0.95, ν).
TEST(Coverage, OneSided) {
  const std::pair<double, double> table[] = {{1, 6.313752},   {2, 2.919986},        {5, 2.015048},
                                             {30, 1.697261},  {199, 1.652547},      {200, 1.652508},
                                             {1e6, 1.644855}, {kInfinite, 1.644854}};
  for (const auto& [freedom, t] : table) EXPECT_NEAR(one_sided_factor(freedom), t, 2e-6) << freedom;
}

}  // namespace
}  // namespace mdof::algo
