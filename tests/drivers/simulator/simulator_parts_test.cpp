// Parts of the simulator: motion and raw readings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "drivers/calibration.h"
#include "drivers/simulator/motion.h"
#include "drivers/simulator/raw_reading.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

SimulatorOptions short_travel() {
  SimulatorOptions options;
  options.targets_mm = {0, 10, 20};
  options.dwell_s = 0.1;
  return options;
}

TEST(SimulatorMotion, StopsOnlyAtTargetsInBothDirections) {
  SimulatorOptions options = short_travel();
  options.targets_mm = {-5, 1, 20};
  const Motion motion(options);
  std::vector<double> rests_mm;
  AxisState last;
  for (std::int64_t t_ns = 0; t_ns < motion.cycle_ns(); t_ns += 1'000'000) {
    const AxisState state = motion.at(t_ns);
    if (state.resting && (!last.resting || state.direction != last.direction))
      rests_mm.push_back(state.direction * to_mm(state.travel_m));
    last = state;
  }
  ASSERT_EQ(rests_mm.size(), 6u);
  const std::vector<double> expected = {-5, 1, 20, -20, -1, 5};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(rests_mm[i], expected[i], 1e-9);
}

TEST(SimulatorMotion, KeepsSpeedAccelerationAndOverruns) {
  const SimulatorOptions options = short_travel();
  const Motion motion(options);
  const double dt_s = 1e-3;
  double low_mm = 0, high_mm = 0, speed_mm_s = 0, acceleration_mm_s2 = 0;
  for (std::int64_t i = 0; i * 1'000'000 < 2 * motion.cycle_ns(); ++i) {
    const auto x_mm = [&](std::int64_t k) {
      return to_mm(motion.at((i + k) * 1'000'000).travel_m);
    };
    low_mm = std::min(low_mm, x_mm(0));
    high_mm = std::max(high_mm, x_mm(0));
    speed_mm_s = std::max(speed_mm_s, std::abs(x_mm(1) - x_mm(0)) / dt_s);
    acceleration_mm_s2 =
        std::max(acceleration_mm_s2, std::abs(x_mm(2) - 2 * x_mm(1) + x_mm(0)) / (dt_s * dt_s));
  }
  EXPECT_NEAR(low_mm, -2, 1e-3);
  EXPECT_NEAR(high_mm, 22, 1e-3);
  EXPECT_NEAR(speed_mm_s, 20, 0.1);
  EXPECT_NEAR(acceleration_mm_s2, 200, 3);
}

TEST(SimulatorMotion, AxisWithoutMotionStaysAtItsTarget) {
  SimulatorOptions options = short_travel();
  options.targets_mm = {7};
  options.overrun_mm = 0;
  options.dwell_s = 0;
  EXPECT_EQ(Motion(options).at(123'456'789).travel_m, from_mm(7));
}

TEST(SimulatorRaw, CalibrationInvertsTheRawReading) {
  Probe probe;
  probe.range_m = 200e-6;
  probe.calibration.reads_gap = true;
  probe.calibration.offset_um = 100;
  probe.calibration.linearity = {{-50, 0.4}, {0, 0}, {60, -0.3}};
  for (int i = -128; i <= 128; ++i) {
    const double displacement_um = i * 0.7;
    const RawReading raw = raw_reading(probe, from_um(displacement_um));
    EXPECT_NEAR(to_um(displacement_m(probe.calibration, raw.um)), displacement_um, 1e-10);
    EXPECT_FALSE(raw.over_range);
  }
}

TEST(SimulatorRaw, LimitsReadingsAtTheEndOfTheRange) {
  Probe probe;
  probe.range_m = 200e-6;
  EXPECT_EQ(raw_reading(probe, 150e-6).um, 100);
  EXPECT_TRUE(raw_reading(probe, 150e-6).over_range);
  EXPECT_EQ(raw_reading(probe, -150e-6).um, -100);
  probe.calibration.reads_gap = true;
  EXPECT_EQ(raw_reading(probe, 150e-6).um, 0);
  EXPECT_EQ(raw_reading(probe, -250e-6).um, 200);
}

}  // namespace
}  // namespace mdof::drivers
