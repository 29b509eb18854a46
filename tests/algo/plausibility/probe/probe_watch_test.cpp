// A probe with a frozen or stepped reading is detected. Logs without faults have no notices.
#include <gtest/gtest.h>

#include "tests/algo/detected.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

TEST(ProbeWatch, HasNoNoticesForSixtyCleanLogs) {
  const double noises_um[] = {0, 0.002, 0.01, 0.05, 0.2};
  const double steps_um[] = {0, 1e-6, 0.003, 0.03, 0.1, 0.15};
  const double rates[] = {200, 500, 1000};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SteppingLog log;
    log.seed = seed;
    log.probe_noise_um = noises_um[seed % 5];
    log.probe_step_um = steps_um[seed % 6];
    log.rate_hz = rates[seed / 2 % 3];
    log.encoder_noise_um = seed % 7 == 0 ? 0.3 : 0.005;
    log.move_s = seed % 4 == 0 ? 0.1 : 0.25;
    log.drift_um_per_min = seed % 3 == 0 ? 0.1 : 0.005;
    const auto found = detect(log, log.frames());
    ASSERT_EQ(found.points.size(), 78u) << seed;
    for (const Point& p : found.points)
      ASSERT_TRUE(p.flags.empty()) << "seed " << seed << ": " << to_string(p.flags);
    ASSERT_EQ(test::shown(found.notices), "") << "seed " << seed;
  }
}

TEST(ProbeWatch, FrozenProbeIsNotUsedAfterItFreezes) {
  for (const double step_um :
       {1e-6, 0.05, 0.1}) {  // with 0.05 and 0.1 most stops have constant readings
    for (const double from_s : {25.3, 30.0, 31.2}) {
      SteppingLog log;
      log.probe_step_um = step_um;
      FrameBlock frames = log.frames();
      const std::size_t row = row_at(frames, from_s);
      for (std::size_t i = row; i < frames.size(); ++i)
        frames.probe_m[2][i] = frames.probe_m[2][row];
      for (const std::size_t block : {13u, 5000u}) {
        const auto found = detect(log, frames, block);
        ASSERT_EQ(found.points.size(), 78u);
        for (const Point& p : found.points) {
          const bool after = p.end_ns > frames.time_ns[row] + 1'000'000'000;
          const bool before = p.end_ns < frames.time_ns[row] - 1'500'000'000;
          if (after) {
            EXPECT_TRUE(std::isnan(p.probe_m[2])) << step_um << " " << from_s;
            EXPECT_TRUE(has_flag(p, Flag::frozen, "C"));
          }
          if (before) {
            EXPECT_TRUE(p.flags.empty()) << step_um << " " << from_s;
          }
          EXPECT_FALSE(std::isnan(p.probe_m[1]));
        }
        ASSERT_EQ(found.notices.size(), 1u) << step_um << " " << from_s;
        EXPECT_EQ(test::shown(found.notices[0]).find("probe_frozen C from_s="), 0u);
      }
    }
  }
}

TEST(ProbeWatch, DetectsAProbeThatIsDeadFromTheStart) {
  SteppingLog log;
  FrameBlock frames = log.frames();
  std::fill(frames.probe_m[3].begin(), frames.probe_m[3].end(), 1.25e-6);
  const auto found = detect(log, frames);
  for (const Point& p : found.points) EXPECT_TRUE(has_flag(p, Flag::frozen, "D"));
  // If the other probes have no noise either, the constant reading may be correct.
  log.probe_noise_um = 0;
  log.probe_step_um = 0;
  log.drift_um_per_min = 0;
  frames = log.frames();
  std::fill(frames.probe_m[3].begin(), frames.probe_m[3].end(), 1.25e-6);
  EXPECT_TRUE(detect(log, frames).notices.empty());
}

TEST(ProbeWatch, FlagsARecoveredProbeOnlyWhileFrozen) {
  SteppingLog log;
  FrameBlock frames = log.frames();
  const std::size_t from = row_at(frames, 20.0), to = row_at(frames, 30.0);
  for (std::size_t i = from; i < to; ++i) frames.probe_m[0][i] = frames.probe_m[0][from];
  const auto found = detect(log, frames);
  for (const Point& p : found.points) {
    const bool meanwhile = p.end_ns >= frames.time_ns[from] && p.begin_ns <= frames.time_ns[to];
    EXPECT_EQ(has_flag(p, Flag::frozen, "A"), meanwhile);
  }
}

TEST(ProbeWatch, ReportsAndFlagsAStepOfOneProbe) {
  for (const double rate : {200.0, 500.0, 4000.0}) {
    for (const double size_um : {-0.6, 24.0}) {
      for (const double at_s : {20.1, 20.3, 20.5, 20.7}) {  // at stops and in motion
        SteppingLog log;
        log.rate_hz = rate;
        FrameBlock frames = log.frames();
        const std::size_t row = row_at(frames, at_s);
        for (std::size_t i = row; i < frames.size(); ++i) frames.probe_m[4][i] += 1e-6 * size_um;
        const auto found = detect(log, frames);
        ASSERT_EQ(found.points.size(), 78u);
        ASSERT_EQ(found.notices.size(), 1u) << rate << " " << size_um << " " << at_s;
        EXPECT_EQ(test::shown(found.notices[0]).find("probe_stepped E step_um="), 0u);
        for (const Point& p : found.points)
          EXPECT_EQ(has_flag(p, Flag::step, "E"), p.end_ns >= frames.time_ns[row]);
      }
    }
  }
}

// If all probes step together, the machine has moved.
TEST(ProbeWatch, IgnoresAStepOfAllProbes) {
  SteppingLog log;
  FrameBlock frames = log.frames();
  for (auto& column : frames.probe_m)
    for (std::size_t i = row_at(frames, 20.2); i < frames.size(); ++i) column[i] += 2e-6;
  EXPECT_TRUE(detect(log, frames).notices.empty());
}

}  // namespace
}  // namespace mdof::algo
