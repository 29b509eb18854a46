// Rules of the device clock: when it has settled, which packets are late, and how fast its times
// may change. The expected values were calculated by hand. tests/mutate showed that these tests
// were missing.
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/clock/device_clock.h"
#include "drivers/counter/unwrap.h"

namespace mdof::drivers {
namespace {

constexpr double kRuleTick_ns = 1'000'000;  // one packet with one sample every millisecond

// Host time of a tick. `ppm`: the device runs faster than the host by this value.
std::int64_t at_ns(std::int64_t tick, double ppm) {
  return 7'000'000'000 + std::llround(static_cast<double>(tick) * kRuleTick_ns / (1 + ppm * 1e-6));
}

TEST(DeviceClockRules, NewClockIsNotSettledAndHasNoDrift) {
  const ClockState state = DeviceClock(kRuleTick_ns).state();
  EXPECT_EQ(state.drift_ppm, 0);
  EXPECT_EQ(state.jitter_ns, 0);
  EXPECT_FALSE(state.settled);
  EXPECT_EQ(state.steps, 0u);
}

// The clock needs sixteen intervals of 0.25 s.
TEST(DeviceClockRules, SettlesAfterFourSeconds) {
  DeviceClock clock(kRuleTick_ns);
  for (std::int64_t tick = 0; tick < 6'000; ++tick) {
    clock.add(tick, at_ns(tick, 0));
    EXPECT_EQ(clock.state().settled, tick >= 4'000) << tick;
    EXPECT_FALSE(clock.state().doubtful) << tick;
  }
}

TEST(DeviceClockRules, UncertainForFourSecondsAfterAStep) {
  DeviceClock clock(kRuleTick_ns);
  for (std::int64_t tick = 0; tick < 5'000; ++tick) clock.add(tick, at_ns(tick, 0));
  for (std::uint64_t steps = 1; steps < 4; ++steps) {
    for (std::int64_t tick = 0; tick < 5'000; ++tick) {
      clock.add(tick, at_ns(tick + 5'000 * static_cast<std::int64_t>(steps), 0));
      EXPECT_EQ(clock.state().doubtful, tick < 4'000) << tick;
      EXPECT_EQ(clock.state().steps, steps);
    }
  }
}

// After a step before the clock has settled, it is uncertain for one second only.
TEST(DeviceClockRules, UncertainForASecondAfterAnEarlyStep) {
  DeviceClock clock(kRuleTick_ns);
  for (std::int64_t tick = 0; tick < 500; ++tick) clock.add(tick, at_ns(tick, 0));
  for (std::int64_t tick = 0; tick < 2'000; ++tick) {
    clock.add(tick, at_ns(tick + 500, 0));
    EXPECT_EQ(clock.state().doubtful, tick < 1'000) << tick;
  }
}

// The lateness of a packet is its delay after the fitted line; the limit of a single packet is
// 0.1 s. Without jitter, a packet may be early by at most 20 ms. The line contains the drift: 500
// ppm in five minutes are 150 ms, which would exceed the limit.
TEST(DeviceClockRules, LatenessIsRelativeToTheLine) {
  for (const double ppm : {500.0, -500.0}) {
    DeviceClock clock(kRuleTick_ns);
    for (std::int64_t tick = 0; tick < 300'000; tick += 100) {
      clock.add(tick, at_ns(tick, ppm));
      ASSERT_FALSE(clock.state().doubtful) << ppm << " " << tick;
      ASSERT_EQ(clock.state().late_ns, 0);
      ASSERT_EQ(clock.state().steps, 0u);
    }
    clock.add(300'000, at_ns(300'000, ppm) + 90'000'000);
    EXPECT_FALSE(clock.state().doubtful) << ppm;
    clock.add(300'020, at_ns(300'020, ppm) + 150'000'000);
    EXPECT_TRUE(clock.state().doubtful) << ppm;
    EXPECT_NEAR(static_cast<double>(clock.state().late_ns), 150e6, 1e5) << ppm;
    clock.add(300'040, at_ns(300'040, ppm));
    EXPECT_FALSE(clock.state().doubtful) << ppm;
    EXPECT_EQ(clock.state().late_ns, 0);
    clock.add(300'060, at_ns(300'060, ppm) - 15'000'000);  // earlier than the fitted line
    EXPECT_EQ(clock.state().steps, 0u) << ppm;
    // This packet is much too early. The device's time must have jumped forward.
    clock.add(300'080, at_ns(300'080, ppm) - 25'000'000);
    EXPECT_EQ(clock.state().steps, 1u) << ppm;
  }
}

TEST(DeviceClockRules, LimitsTheDriftToAThousandPpm) {
  for (const double ppm : {3'000.0, -3'000.0}) {
    DeviceClock clock(kRuleTick_ns);
    for (std::int64_t tick = 0; tick < 6'000; ++tick) clock.add(tick, at_ns(tick, ppm));
    EXPECT_NEAR(clock.state().drift_ppm, ppm > 0 ? 1'000 : -1'000, 1e-6);
  }
}

// The drift changes, for example because the device warms up. After 70 s the clock shows only the
// new drift, because it uses packets of the last 64 s.
TEST(DeviceClockRules, ForgetsPacketsOlderThanAMinute) {
  DeviceClock clock(kRuleTick_ns);
  for (std::int64_t tick = 0; tick < 200'000; tick += 5) clock.add(tick, at_ns(tick, 50));
  EXPECT_NEAR(clock.state().drift_ppm, 50, 0.01);
  const std::int64_t later_ns = at_ns(200'000, 50) - at_ns(200'000, 80);
  for (std::int64_t tick = 200'000; tick < 270'000; tick += 5)
    clock.add(tick, at_ns(tick, 80) + later_ns);
  EXPECT_NEAR(clock.state().drift_ppm, 80, 0.01);
}

// The packets of three of five intervals have a jitter of 2 ms. The packets of the other intervals
// have no jitter.
TEST(DeviceClockRules, JitterIsTheMedianOverIntervals) {
  DeviceClock clock(kRuleTick_ns);
  for (std::int64_t tick = 0; tick < 10'000; ++tick) {
    const bool spread = tick / 250 % 5 < 3 && tick % 2;
    clock.add(tick, at_ns(tick, 0) + (spread ? 2'000'000 : 0));
  }
  EXPECT_EQ(clock.state().jitter_ns, 2'000'000);
}

// The first time that the clock returns is on the fitted line, although the first packet was late.
TEST(DeviceClockRules, FirstTimeIsOnTheLine) {
  DeviceClock clock(kRuleTick_ns);
  clock.add(0, at_ns(0, 0) + 50'000'000);
  clock.add(10, at_ns(10, 0));
  EXPECT_EQ(clock.host_ns(10), at_ns(10, 0));
}

// The fitted line may move. The returned times follow the line without steps. To follow it, their
// rate may differ from the rate of the device by at most 20 % before the clock has settled, and by
// at most 0.2 % afterwards.
TEST(DeviceClockRules, RateOfTheTimesIsLimited) {
  for (const double ppm : {800.0, -800.0}) {
    DeviceClock clock(kRuleTick_ns);
    double least = 2, most = 0, settled_rate_error = 0;
    std::int64_t last_ns = 0;
    for (std::int64_t tick = 0; tick < 12'000; ++tick) {
      const std::int64_t busy_ns = tick < 50 ? 30'000'000 : 0;
      clock.add(tick, at_ns(tick, ppm) + busy_ns);
      const std::int64_t ns = clock.host_ns(tick);
      const double rate = static_cast<double>(ns - last_ns) / kRuleTick_ns;
      last_ns = ns;
      if (tick == 0) continue;
      if (clock.state().settled) {
        settled_rate_error = std::max(settled_rate_error, std::abs(rate - 1 / (1 + ppm * 1e-6)));
      } else {
        least = std::min(least, rate);
        most = std::max(most, rate);
      }
    }
    EXPECT_NEAR(least, 0.8, 1e-5) << ppm;  // 30 ms are corrected within 150 ms
    EXPECT_LE(most, 1 + 1e-5) << ppm;
    EXPECT_LE(settled_rate_error, 2e-3 + 1e-5) << ppm;
    // The first line of a slow device assumes no drift and therefore has an error of 3 ms.
    EXPECT_GE(settled_rate_error, ppm < 0 ? 2e-3 - 1e-5 : 0);
    EXPECT_LT(std::abs(static_cast<double>(last_ns - at_ns(11'999, ppm))), 1'000) << ppm;
  }
}

TEST(Unwrap, FirstReadingIsTakenAsItIs) {
  EXPECT_EQ(Unwrap(16)(0xFFFF), 65'535);
  EXPECT_EQ(Unwrap(16, true)(0xFFFF), -1);
  EXPECT_EQ(Unwrap(16, true)(0x8000), -32'768);
  EXPECT_EQ(Unwrap(16, true)(5), 5);
  EXPECT_EQ(Unwrap(16, true)(0x7FFF), 32'767);
}

TEST(Unwrap, ContinuesOverBothEnds) {
  Unwrap count(8);
  const std::uint64_t raw[] = {250, 5, 120, 240, 10, 0x1FF};
  const std::int64_t whole[] = {250, 261, 376, 496, 522, 511};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(count(raw[i]), whole[i]) << i;
  count.reset();
  EXPECT_EQ(count(3), 3);
}

}  // namespace
}  // namespace mdof::drivers
