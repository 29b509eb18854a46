#include "schema/targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "schema/rig/rig.h"
#include "tests/shown.h"

namespace mdof {
namespace {

TEST(Targets, AreEquallySpacedWithoutJitterAndNearbyWithJitter) {
  EXPECT_EQ(spaced_targets_mm({.from_mm = -5, .to_mm = 10, .interval_mm = 5}),
            (std::vector<double>{-5, 0, 5, 10}));
  const TargetSpacing jittered{.from_mm = 0, .to_mm = 60, .interval_mm = 5, .jitter_mm = 1};
  const auto targets = spaced_targets_mm(jittered);
  ASSERT_EQ(targets.size(), 13u);
  bool moved = false;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    EXPECT_NEAR(targets[i], 5.0 * static_cast<double>(i), 1);
    moved = moved || targets[i] != 5.0 * static_cast<double>(i);
  }
  EXPECT_TRUE(moved);
  EXPECT_EQ(targets, spaced_targets_mm(jittered));
}

TEST(Targets, JitterStaysWithinTheEnds) {
  for (int seed = 1; seed < 20; ++seed) {
    const auto targets = spaced_targets_mm(
        {.from_mm = 0, .to_mm = 40, .interval_mm = 10, .jitter_mm = 4.9, .seed = seed});
    EXPECT_GE(targets.front(), 0);
    EXPECT_LE(targets.back(), 40);
    EXPECT_TRUE(std::is_sorted(targets.begin(), targets.end()));
  }
}

TEST(Targets, ErrorsNameTheKey) {
  EXPECT_FALSE(check_spacing({}));
  EXPECT_STREQ(check_spacing({.from_mm = 5, .to_mm = 5})->key, "to_mm");
  EXPECT_STREQ(check_spacing({.interval_mm = 0})->key, "interval_mm");
  EXPECT_STREQ(check_spacing({.interval_mm = 1e-5})->key, "interval_mm");
  EXPECT_STREQ(check_spacing({.interval_mm = 4, .jitter_mm = 2})->key, "jitter_mm");
  EXPECT_STREQ(check_spacing({.to_mm = std::numeric_limits<double>::quiet_NaN()})->key, "to_mm");
}

TEST(Targets, ReportsIntervalsOfWholeScalePeriods) {
  EXPECT_TRUE(scale_period_notice({0, 5, 10}, 20));  // each interval is 250 periods
  EXPECT_TRUE(scale_period_notice({0, 5, 12}, 20));  // the intervals are 250 and 350 periods
  EXPECT_FALSE(scale_period_notice({0, 5.007, 10}, 20));
  EXPECT_FALSE(scale_period_notice({0, 5, 10}, 0));
  EXPECT_FALSE(scale_period_notice({0}, 20));
}

TEST(Calibrations, ReportsAnOverdueCalibration) {
  Rig rig;
  rig.probes.resize(3);
  rig.probes[0].id = "A";
  rig.probes[1].id = "B";
  rig.probes[1].calibration.due = "2026-05-01";
  rig.probes[1].calibration.certificate = "K-77";
  rig.probes[2].id = "C";
  rig.probes[2].calibration.due = "2026-06-01";
  EXPECT_TRUE(overdue_calibrations(rig, "2026-05-01T23:59:59Z").empty());
  const auto overdue = overdue_calibrations(rig, "2026-05-02T00:00:00Z");
  ASSERT_EQ(overdue.size(), 1u);
  EXPECT_EQ(test::shown(overdue[0]), "calibration_overdue B due=2026-05-01 certificate=K-77");
}

TEST(Calibrations, ReportsACalibrationThatIsLaterThanTheMeasurement) {
  Rig rig;
  rig.probes.resize(1);
  rig.probes[0].id = "A";
  rig.probes[0].calibration.calibrated = "2026-05-02";
  rig.probes[0].calibration.certificate = "K-77";
  EXPECT_TRUE(overdue_calibrations(rig, "2026-05-02T00:00:00Z").empty());
  const auto found = overdue_calibrations(rig, "2026-05-01T23:59:59Z");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(test::shown(found[0]),
            "calibrated_after_measurement A calibrated=2026-05-02 day=2026-05-01 certificate=K-77");
}

}  // namespace
}  // namespace mdof
