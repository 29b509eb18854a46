// Results of ISO 230-2, calculated by hand for two targets, and the notices about the plan of a
// test. tests/tools/iso230_test checks readings of real machines.
#include "algo/iso230/positioning/positioning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "algo/iso230/positioning/positioning_uncertainty.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

const double kRoot2 = std::sqrt(2.0);

// Readings {target, direction, run, deviation}. The means forward and reverse are 1 and 6 with s =
// √2 and 2√2 at the first target, 10 and 8 with s = 0 and √2 at the second target.
std::vector<PositioningReading> two_targets() {
  return {{1, -1, 2, 9}, {0, 1, 1, 0},  {0, 1, 2, 2},  {0, -1, 1, 4},
          {1, 1, 1, 10}, {0, -1, 2, 8}, {1, 1, 2, 10}, {1, -1, 1, 7}};
}

std::vector<PositioningReading> of_direction(int direction) {
  auto readings = two_targets();
  std::erase_if(readings, [&](const auto& r) { return r.direction != direction; });
  return readings;
}

TEST(Positioning, MatchesTheCalculationByHand) {
  const Positioning p = positioning(two_targets()).value();
  EXPECT_DOUBLE_EQ(p.B, 5);
  EXPECT_DOUBLE_EQ(p.B_mean, -1.5);
  EXPECT_DOUBLE_EQ(p.R_forward, 4 * kRoot2);
  EXPECT_DOUBLE_EQ(p.R_reverse, 8 * kRoot2);
  EXPECT_DOUBLE_EQ(p.R, 6 * kRoot2 + 5);
  EXPECT_DOUBLE_EQ(p.E_forward, 9);
  EXPECT_DOUBLE_EQ(p.E_reverse, 2);
  EXPECT_DOUBLE_EQ(p.E, 9);
  EXPECT_DOUBLE_EQ(p.M, 5.5);
  EXPECT_DOUBLE_EQ(p.A_forward, 9 + 2 * kRoot2);
  EXPECT_DOUBLE_EQ(p.A_reverse, 8 * kRoot2);
  EXPECT_DOUBLE_EQ(p.A, 5 + 6 * kRoot2);
}

TEST(Positioning, GivesEachTarget) {
  const Positioning p = positioning(two_targets()).value();
  ASSERT_EQ(p.targets.size(), 2u);
  const PositioningTarget& second = p.targets[1];
  EXPECT_EQ(second.target_m, 1);
  EXPECT_EQ(second.reverse.n, 2u);
  EXPECT_DOUBLE_EQ(second.forward.mean, 10);
  EXPECT_DOUBLE_EQ(second.reverse.s, kRoot2);
  EXPECT_DOUBLE_EQ(second.mean, 9);
  EXPECT_DOUBLE_EQ(second.B, 2);
  EXPECT_DOUBLE_EQ(second.R, 4 * kRoot2);  // reverse approach, which exceeds 2√2 + 2
}

TEST(Positioning, OneDirectionHasItsOwnResultsOnly) {
  const Positioning p = positioning(of_direction(-1)).value();
  EXPECT_DOUBLE_EQ(p.R_reverse, 8 * kRoot2);
  EXPECT_DOUBLE_EQ(p.E_reverse, 2);
  EXPECT_DOUBLE_EQ(p.A_reverse, 8 * kRoot2);
  for (const double unknown : {p.B, p.B_mean, p.R_forward, p.R, p.E_forward, p.E, p.M, p.A_forward,
                               p.A, p.targets[0].B, p.targets[0].forward.mean})
    EXPECT_TRUE(std::isnan(unknown)) << unknown;
}

// B, E and M have values for a single run; R and A need a second run.
TEST(Positioning, SingleRunHasMeansOnly) {
  auto readings = two_targets();
  std::erase_if(readings, [](const auto& r) { return r.run == 2; });
  // Deviations 0 and 4 at target 1, 10 and 7 at target 2.
  const Positioning p = positioning(readings).value();
  EXPECT_EQ(p.B, 4);
  EXPECT_EQ(p.B_mean, -0.5);
  EXPECT_EQ(p.E_forward, 10);
  EXPECT_EQ(p.E_reverse, 3);
  EXPECT_EQ(p.E, 10);
  EXPECT_EQ(p.M, 6.5);
  for (const double unknown : {p.R_forward, p.R_reverse, p.R, p.A_forward, p.A_reverse, p.A,
                               p.targets[0].R, p.targets[1].forward.s})
    EXPECT_TRUE(std::isnan(unknown)) << unknown;
}

std::string refused(const std::vector<PositioningReading>& readings) {
  const auto p = positioning(readings);
  return p ? "" : p.error().message;
}

TEST(Positioning, RefusesInvalidReadings) {
  EXPECT_NE(refused({}).find("0 target(s)"), std::string::npos);
  EXPECT_NE(refused({{0, 1, 1, 1}, {0, 1, 2, 2}}).find("1 target(s)"), std::string::npos);
  auto readings = two_targets();
  readings[1].direction = 0;
  EXPECT_NE(refused(readings).find("target 0 mm, run 1: the direction is 0"), std::string::npos);
  for (const double bad : {std::nan(""), 1e300, -std::numeric_limits<double>::infinity()}) {
    readings = two_targets();
    readings[3].deviation = bad;
    EXPECT_NE(refused(readings).find("run 1: a target or deviation is not"), std::string::npos);
    readings = two_targets();
    readings[3].target_m = bad;
    EXPECT_NE(refused(readings).find("run 1: a target or deviation is not"), std::string::npos);
  }
}

TEST(Positioning, NamesTheTargetThatLacksReadings) {
  auto readings = two_targets();
  readings.pop_back();  // target 2 in run 1, reverse
  EXPECT_NE(refused(readings).find("target 1000 mm: only one reading in reverse direction"),
            std::string::npos);
  readings.erase(readings.begin());
  EXPECT_NE(refused(readings).find("target 1000 mm: no reading in reverse direction, but other"),
            std::string::npos);
}

// Limits of ±2√3 µm of the device are U = 4 µm with k = 2. A drift of 5 µm is U = 3 µm.
TEST(PositioningUncertainty, CombinesDeviceAndDrift) {
  const PositioningUncertainty U = positioning_uncertainty({2e-6 * std::sqrt(3.0), 5e-6});
  EXPECT_DOUBLE_EQ(U.device, 4e-6);
  EXPECT_DOUBLE_EQ(U.drift, 3e-6);
  EXPECT_DOUBLE_EQ(U.E_M_A, 5e-6);
  EXPECT_DOUBLE_EQ(U.B, 3e-6);
}

TEST(PositioningUncertainty, IsUnknownWithoutADeclaration) {
  PositioningConditions drift_alone;
  drift_alone.drift_range_m = 5e-6;
  const PositioningUncertainty U = positioning_uncertainty(drift_alone);
  EXPECT_DOUBLE_EQ(U.B, 3e-6);
  EXPECT_TRUE(std::isnan(U.device));
  EXPECT_TRUE(std::isnan(U.E_M_A));
}

// Results for targets at `targets_m` with `runs` readings in each direction.
Positioning planned(const std::vector<double>& targets_m, int runs = 5) {
  std::vector<PositioningReading> readings;
  for (const double target_m : targets_m)
    for (int run = 1; run <= runs; ++run)
      for (const int direction : {1, -1})
        readings.push_back({target_m, direction, run, 1e-6 * run});
  return positioning(readings).value();
}

std::string notices_of(const Positioning& p, double scale_period_m = 0) {
  return test::shown(plan_notices(p, scale_period_m));
}

const std::vector<double> kGood_m = {0, 0.011, 0.0202, 0.0297, 0.0404};

// Positions as deviations: 40.4 mm as 40400 µm, or as 40.4. The deviations themselves have a slope
// of 20 µm/m.
TEST(Slope, ReportsPositionsInsteadOfDeviations) {
  for (const auto& [slope, stated] :
       {std::pair{0.0, false}, std::pair{1.0, true}, std::pair{-1.0, true}, std::pair{1e-3, true},
        std::pair{0.9e-3, false}, std::pair{20e-3, false}})
    for (const int least_direction : {-1, 1}) {
      std::vector<PositioningReading> readings;
      for (const double target_m : kGood_m)
        for (int direction = least_direction; direction <= 1; direction += 2)
          readings.push_back({target_m, direction, 1, (slope + 20e-6) * target_m + 5e-6});
      const Notices found = slope_notices(positioning(readings).value());
      ASSERT_EQ(found.size(), stated ? 1U : 0U) << slope << " " << least_direction;
      if (!stated) continue;
      EXPECT_EQ(found[0].code, NoticeCode::deviations_follow_targets);
      EXPECT_NEAR(std::get<double>(*value(found[0], "slope_um_per_mm")), 1e3 * (slope + 20e-6),
                  1e-9);
    }
}

TEST(Plan, FiveUnevenTargetsAndRunsAreEnough) {
  EXPECT_EQ(notices_of(planned(kGood_m)), "");
  EXPECT_EQ(notices_of(planned(kGood_m), 1e-3), "");
}

TEST(Plan, ReportsTooFewTargetsAndRuns) {
  const std::vector<double> four(kGood_m.begin(), kGood_m.end() - 1);
  EXPECT_NE(notices_of(planned(four)).find("few_targets targets=4 travel_mm=29.7 needed=5"),
            std::string::npos);
  EXPECT_NE(notices_of(planned({0, 0.3, 0.5, 0.81, 1.3})).find("needed=7"), std::string::npos);
  EXPECT_EQ(notices_of(planned({0, 0.3, 0.5, 0.81, 1.0})), "");
  EXPECT_NE(notices_of(planned(kGood_m, 4)).find("few_runs runs=4 some_targets=0"),
            std::string::npos);
  EXPECT_NE(notices_of(planned(kGood_m, 1)).find("single_run"), std::string::npos);
  EXPECT_EQ(notices_of(planned(kGood_m, 1)).find("few_runs"), std::string::npos);
  EXPECT_NE(notices_of(planned({0, 0.3, 0.5, 0.81, 1, 1.3, 1.4, 1.6, 1.7, 1.9, 2.01}))
                .find("travel_over_2_m travel_mm=2010"),
            std::string::npos);
}

TEST(Plan, ReportsUnevenRunsAndOneDirection) {
  Positioning uneven = planned(kGood_m);
  uneven.targets[2].reverse.n = 3;
  EXPECT_NE(notices_of(uneven).find("few_runs runs=3 some_targets=1"), std::string::npos);
  EXPECT_NE(notices_of(uneven).find("uneven_readings least=3 most=5"), std::string::npos);
  const Positioning one_side = positioning(of_direction(1)).value();
  EXPECT_NE(notices_of(one_side).find("one_approach"), std::string::npos);
}

TEST(Plan, ReportsEqualIntervalsAndWholePeriods) {
  const std::vector<double> equal = {0.015, 0.025, 0.035, 0.045, 0.055};
  EXPECT_NE(notices_of(planned(equal)).find("equal_intervals"), std::string::npos);
  EXPECT_NE(notices_of(planned(equal), 5e-3).find("scale_period_hidden period_um=5000"),
            std::string::npos);
  EXPECT_NE(notices_of(planned({0, 0.01, 0.03, 0.04, 0.06}), 5e-3).find("scale_period_hidden"),
            std::string::npos);
  EXPECT_EQ(notices_of(planned({0, 0.01, 0.03, 0.04, 0.06}), 7e-3), "");
}

}  // namespace
}  // namespace mdof::algo
