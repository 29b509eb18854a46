// What remains of drifts that are not removed, and the uncertainty of drifts of few visits.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/drift/drift_sentences.h"
#include "algo/drift/run_drift.h"
#include "tests/algo/drift/drift_log.h"

namespace mdof::algo {
namespace {

// At the first target, the visits of the two approaches are 50 s apart.
TEST(RunDrift, ChangesThatAreNotRemovedAreInTheReversal) {
  Log log;
  log.noise_m = kNoise;
  log.drift = [&](double t) { return -200e-9 * t / log.length_s(); };
  const double of_drift_m = -200e-9 * 50 / log.length_s();
  const auto points = log.points();
  const DriftOfRun drift(points);
  const Errors5 left = drift.left_in_reversal(points, false);
  EXPECT_NEAR(left[kDy], of_drift_m, 4e-9);
  for (const std::size_t k : {kDz, kEx, kEy, kEz}) EXPECT_EQ(left[k], 0);
  EXPECT_EQ(drift.left_in_reversal(points, true)[kDy], 0);
  EXPECT_EQ(reversal_notices(drift, points, {}, false).at(0).code, NoticeCode::drift_in_reversal);
  EXPECT_TRUE(reversal_notices(drift, points, {}, true).empty());

  log.reversal = [](int target) { return 20e-9 * target; };  // then the drift may be steps
  const auto varying = log.points();
  const DriftOfRun steps(varying);
  ASSERT_TRUE(steps.found().errors[kDy].steps);
  EXPECT_NEAR(steps.left_in_reversal(varying, true)[kDy], of_drift_m, 8e-9);
  for (const bool is_removed : {false, true})  // --remove-drift has no effect, so it is no remedy
    EXPECT_EQ(reversal_notices(steps, varying, {}, is_removed).at(0).code,
              NoticeCode::change_in_reversal);

  log.drift = [](double) { return 0.0; };
  const auto still = log.points();
  EXPECT_EQ(DriftOfRun(still).left_in_reversal(still, false), Errors5{});
}

// A distribution with one maximum has 95 % within 2.98 standard deviations (Vysochanskij, Petunin).
// Four degrees of freedom of the noise and the 3.4 of this limit give at least 1.8 together.
TEST(RunDrift, FewVisitsDoNotGiveAlmostNoDegreesOfFreedom) {
  int removed = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    Log log;
    log.runs = 2 + static_cast<int>(seed % 2);
    log.targets = 5;
    log.noise_m = kNoise;
    log.seed = seed;
    log.drift = [&](double t) { return 200e-9 * (1 - std::exp(-3 * t / log.length_s())); };
    const DriftOfRun drift(log.points());
    if (!drift.found().removable()) continue;
    ++removed;
    EXPECT_GE(drift.freedom(), 1 / (1 / 4.0 + 1 / 3.39)) << seed;
  }
  EXPECT_GE(removed, 20);
}

}  // namespace
}  // namespace mdof::algo
