// Jumps of a device's time that are not much larger than the jitter of the link, and links with
// jitter but without jumps. The error of a returned time is its distance from the true time that
// was simulated.
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/clock/device_clock.h"
#include "schema/base/random.h"

namespace mdof::drivers {
namespace {

constexpr std::int64_t kBegin_ns = 5'000'000'000;

// A device that sends a packet every `interval_ns`, over a link with a random delay.
struct Link {
  std::int64_t interval_ns;
  double (*delay_ns)(double);  // from a random number between 0 and 1
};

Link quiet() {
  return {4'000'000, [](double u) { return 0.1e6 + 3e6 * u; }};
}

struct Seen {
  std::int64_t doubtful = 0;         // number of packets with a flag
  std::int64_t first_unflagged = 0;  // number of packets after the jump until the first flag
  double worst_unflagged_ms = 0;     // largest error without a flag
  std::uint64_t steps = 0;
};

// Simulates `end_s` of the device. At `at_s` its time jumps forward by `jump_ns`; negative: it
// stands still for this time. Errors are counted from 1 s on, and after a jump from the first flag
// on.
Seen simulate(const Link& link, double end_s, double at_s = 1e9, std::int64_t jump_ns = 0,
              std::uint32_t seed = 1) {
  DeviceClock clock(1.0);
  Seen seen;
  bool flagged = false;
  std::int64_t last_ns = 0;
  const auto end = static_cast<std::int64_t>(end_s * 1e9);
  for (std::int64_t p = 0; p * link.interval_ns < end; ++p) {
    const std::int64_t counted_ns = p * link.interval_ns;
    const Philox r = philox({static_cast<std::uint32_t>(p), 0, 0, 0}, seed);
    const bool jumped = static_cast<double>(counted_ns) >= at_s * 1e9;
    const std::int64_t ticks = counted_ns + (jumped ? std::max<std::int64_t>(jump_ns, 0) : 0);
    const std::int64_t since_ns = ticks - (jumped ? jump_ns : 0);
    last_ns = std::max(last_ns, kBegin_ns + since_ns +
                                    static_cast<std::int64_t>(link.delay_ns(uniform(r[0], r[1]))));
    clock.add(ticks, last_ns);
    const double error_ms = static_cast<double>(clock.host_ns(ticks) - kBegin_ns - since_ns) * 1e-6;
    seen.doubtful += clock.doubtful();
    flagged = flagged || clock.doubtful();
    seen.first_unflagged += jumped && !flagged;
    if (!clock.doubtful() && since_ns > 1'000'000'000 && (!jumped || flagged))
      seen.worst_unflagged_ms = std::max(seen.worst_unflagged_ms, std::abs(error_ms));
  }
  seen.steps = clock.steps();
  return seen;
}

// The first packet after the jump arrives too early, so it is flagged. The time is flagged until a
// new line is fitted: 4 s are 1000 packets.
TEST(DeviceClockJumps, AJumpForwardIsFlaggedAtOnce) {
  for (const std::int64_t jump_ms : {30, 50, 70, 90})
    for (const double at_s : {6.0, 70.0, 100.0}) {
      const Seen seen = simulate(quiet(), at_s + 100, at_s, jump_ms * 1'000'000);
      EXPECT_EQ(seen.first_unflagged, 0) << jump_ms << " ms at " << at_s;
      EXPECT_EQ(seen.steps, 1u) << jump_ms << " ms at " << at_s;
      EXPECT_NEAR(static_cast<double>(seen.doubtful), 1'000, 70) << jump_ms << " ms at " << at_s;
      EXPECT_LT(seen.worst_unflagged_ms, 3.1) << jump_ms << " ms at " << at_s;
    }
}

// A time that stands still looks like a slow link. It is flagged after 0.25 s (63 packets) and for
// a minute, then until a new line is fitted.
TEST(DeviceClockJumps, ATimeThatStandsStillIsFlaggedAfterAQuarterOfASecond) {
  for (const std::int64_t still_ms : {30, 50, 70, 90})
    for (const double at_s : {6.0, 70.0}) {
      const Seen seen = simulate(quiet(), at_s + 120, at_s, -still_ms * 1'000'000);
      EXPECT_NEAR(static_cast<double>(seen.first_unflagged), 63, 3) << still_ms << " ms";
      EXPECT_EQ(seen.steps, 1u) << still_ms << " ms";
      EXPECT_LT(seen.worst_unflagged_ms, 3.1) << still_ms << " ms";
    }
}

// Links without a fault: every packet has the delay of the link only.
TEST(DeviceClockJumps, JitterIsNotFlagged) {
  const std::pair<const char*, Link> links[] = {
      {"3 ms", quiet()},
      {"exponential, mean 5 ms", {4'000'000, [](double u) { return -5e6 * std::log(1 - u); }}},
      {"one packet in 500 late by 80 ms",
       {2'000'000, [](double u) { return u < 0.002 ? 80e6 : 1e6 * u; }}},
      {"2 Hz, up to 60 ms", {500'000'000, [](double u) { return 60e6 * u; }}},
      {"10 Hz, up to 30 ms", {100'000'000, [](double u) { return 30e6 * u; }}},
  };
  for (const auto& [name, link] : links)
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const Seen seen = simulate(link, 300, 1e9, 0, seed);
      EXPECT_EQ(seen.doubtful, 0) << name << ", seed " << seed;
      EXPECT_EQ(seen.steps, 0u) << name << ", seed " << seed;
    }
}

// A serial adapter sends every 16 ms. The interval of the device is 100 ppm longer than 16 ms, so
// the delay increases slowly to 16 ms and then jumps to 0.
TEST(DeviceClockJumps, AnAdapterThatSendsInIntervalsIsNotFlagged) {
  DeviceClock clock(1.0);
  for (std::int64_t k = 0; k < 60'000; ++k) {
    const std::int64_t made_ns = k * 16'001'600, timer_ns = 16'000'000;
    clock.add(made_ns, kBegin_ns + (made_ns + timer_ns - 1) / timer_ns * timer_ns);
    clock.host_ns(made_ns);
    ASSERT_FALSE(clock.doubtful()) << k;
  }
}

}  // namespace
}  // namespace mdof::drivers
