// Frames without an encoder position (NaN): a few, many, from the first frame on, or all. The
// expected positions are the stops of the log.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/points/robust_mean.h"
#include "tests/algo/detected.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

void lose(FrameBlock& frames, std::size_t row) {
  frames.encoder_m[row] = kNaN;
  for (auto& quality : frames.probe_quality) {
    quality.resize(frames.size(), Quality::good);
    quality[row] = Quality::missing;
  }
}

SteppingLog one_run() {
  SteppingLog log;
  log.runs = 1;
  return log;
}

const std::size_t kBlocks[] = {1, 13, 100'000};

// Three of five scans of one stop have no position. The point is the mean of the other scans and
// has a flag.
TEST(MissingEncoder, AveragesAStopWithMostPositionsMissing) {
  const SteppingLog log = one_run();
  const FrameBlock whole = log.frames();
  const auto clean = detect(log, whole, 1000);
  FrameBlock frames = whole;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool inside = clean.points[4].begin_ns <= frames.time_ns[i] &&
                        frames.time_ns[i] <= clean.points[4].end_ns;
    if (inside && i % 5 < 3) lose(frames, i), ++lost;
  }
  ASSERT_GT(lost, 100u);
  for (const std::size_t block : kBlocks) {
    const auto found = detect(log, frames, block);
    ASSERT_EQ(found.points.size(), 26u);
    EXPECT_NEAR(found.points[4].position_m, 20e-3, 5e-9);
    EXPECT_NEAR(found.points[4].probe_m[0], 1e-6 * log.readings_um(20)[0], 10e-9);
    for (std::size_t i = 0; i < found.points.size(); ++i)
      EXPECT_EQ(has_flag(found.points[i], Flag::missing, "encoder"), i == 4) << i;
    EXPECT_EQ(found.summary.unplaced, lost);
    ASSERT_EQ(found.notices.size(), 1u);
    EXPECT_EQ(found.notices[0].code, NoticeCode::position_missing);
    EXPECT_EQ(test::number(found.notices[0], "scans"), static_cast<double>(lost));
  }
}

TEST(MissingEncoder, FirstFramesMayHaveNoPosition) {
  const SteppingLog log = one_run();
  FrameBlock frames = log.frames();
  const auto clean = detect(log, frames, 1000);
  for (const std::size_t first : {0u, 1u, 5u}) lose(frames, first);
  for (const std::size_t block : kBlocks) {
    const auto found = detect(log, frames, block);
    ASSERT_EQ(found.points.size(), clean.points.size());
    for (std::size_t i = 0; i < clean.points.size(); ++i)
      EXPECT_NEAR(found.points[i].position_m, clean.points[i].position_m, 1e-9);
    EXPECT_NEAR(found.summary.encoder_min_m, clean.summary.encoder_min_m, 1e-6);
    EXPECT_NEAR(found.summary.encoder_max_m, clean.summary.encoder_max_m, 1e-6);
  }
}

// The positions are missing for a second, while the axis moves from stop 3 to stop 5. This is a
// hole.
TEST(MissingEncoder, ManyMissingPositionsInARowAreAHole) {
  const SteppingLog log = one_run();
  FrameBlock frames = log.frames();
  const auto clean = detect(log, frames, 1000);
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (clean.points[2].end_ns < frames.time_ns[i] && frames.time_ns[i] < clean.points[4].begin_ns)
      lose(frames, i);
  for (const std::size_t block : kBlocks) {
    const auto found = detect(log, frames, block);
    ASSERT_EQ(found.points.size(), 25u);
    ASSERT_EQ(found.notices.size(), 2u);
    EXPECT_EQ(found.notices[0].code, NoticeCode::recording_hole);
    EXPECT_TRUE(std::isnan(found.points[3].travel_min_m)) << "a way that nobody saw";
  }
}

constexpr double kOverflow_m = 4'294'967'296 * 0.05e-6;  // 2^32 counts of 50 nm

TEST(UnreachablePlace, ShortOverflowLosesOnlyItsScans) {
  const SteppingLog log = one_run();
  FrameBlock frames = log.frames();
  const auto clean = detect(log, frames, 1000);
  const std::size_t at = row_at(frames, 1e-9 * static_cast<double>(clean.points[6].begin_ns)) + 20;
  for (const std::size_t row : {std::size_t{0}, at, at + 1, at + 2, at + 3, at + 4})
    frames.encoder_m[row] += kOverflow_m;
  for (const std::size_t block : kBlocks) {
    const auto found = detect(log, frames, block);
    ASSERT_EQ(found.points.size(), 26u);
    EXPECT_EQ(found.summary.unplaced, 6u);
    EXPECT_LT(found.summary.encoder_max_m, 0.1);
    for (std::size_t i = 0; i < 26; ++i) {
      EXPECT_NEAR(found.points[i].position_m, clean.points[i].position_m, 2e-9) << i;
      EXPECT_EQ(has_flag(found.points[i], Flag::missing, "encoder"), i == 6) << i;
    }
    ASSERT_EQ(found.notices.size(), 1u) << test::shown(found.notices);
    EXPECT_EQ(found.notices[0].code, NoticeCode::position_unreachable);
    EXPECT_EQ(test::number(found.notices[0], "scans"), 6);
  }
}

// From stop 7 on the count is wrong. No later scan has a valid position, and a notice reports this.
// A jump of 1 mm has the same effect if the maximum speed of the axis is declared.
TEST(UnreachablePlace, LeavesOutPositionsAfterAJump) {
  const SteppingLog log = one_run();
  const FrameBlock whole = log.frames();
  const auto clean = detect(log, whole, 1000);
  const std::size_t at = row_at(whole, 1e-9 * static_cast<double>(clean.points[6].end_ns)) - 20;
  const struct {
    double jump_m;
    DwellOptions options;
    double jump_mm;
  } cases[] = {{kOverflow_m, {}, 214748.4},
               {-kOverflow_m, {}, -214748.4},
               {1e-3, {.max_speed_m_s = 0.1}, 1},
               {-1e-3, {.max_speed_m_s = 0.1}, -1}};
  for (const auto& c : cases) {
    FrameBlock frames = whole;
    for (std::size_t i = at; i < frames.size(); ++i) frames.encoder_m[i] += c.jump_m;
    for (const std::size_t block : kBlocks) {
      const auto found = detect(log, frames, block, c.options);
      ASSERT_EQ(found.points.size(), 7u) << c.jump_mm;
      EXPECT_TRUE(has_flag(found.points[6], Flag::missing, "encoder"));
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(found.points[i].position_m, clean.points[i].position_m, 5e-9);
      ASSERT_EQ(found.notices.size(), 1u);
      EXPECT_EQ(found.notices[0].code, NoticeCode::position_unreachable);
      EXPECT_NEAR(test::number(found.notices[0], "jump_mm"), c.jump_mm, 0.1);
      EXPECT_NEAR(test::number(found.notices[0], "position_mm"), 30, 0.1);
      EXPECT_EQ(test::number(found.notices[0], "max_speed_mm_s"), 1e3 * c.options.max_speed_m_s);
    }
  }
}

// A disturbance: the positions are far away. They return by a distance that the axis could travel,
// or after missing positions.
TEST(UnreachablePlace, DisturbanceLosesOnlyItsScans) {
  const SteppingLog log = one_run();
  const FrameBlock whole = log.frames();
  const auto clean = detect(log, whole, 1000);
  const std::size_t at = row_at(whole, 1e-9 * static_cast<double>(clean.points[6].begin_ns)) + 30;
  const std::vector<std::vector<double>> off_m = {
      {0.3}, {0.3, kNaN, kNaN, kNaN}, {0.3, 0.12, 0.04}, {-0.3, kNaN}, {0.3, 0.3, kNaN, -0.1}};
  for (const auto& off : off_m) {
    FrameBlock frames = whole;
    for (std::size_t i = 0; i < off.size(); ++i) frames.encoder_m[at + i] += off[i];
    for (const std::size_t block : kBlocks) {
      const auto found = detect(log, frames, block);
      ASSERT_EQ(found.points.size(), clean.points.size());
      EXPECT_EQ(found.summary.unplaced, off.size());
      for (std::size_t i = 0; i < found.points.size(); ++i)
        EXPECT_NEAR(found.points[i].position_m, clean.points[i].position_m, 5e-9);
    }
  }
}

TEST(UnreachablePlace, AxisAtItsGreatestSpeedLosesNothing) {
  const SteppingLog log = one_run();  // its speed is up to 1.875 · 5 mm / 0.25 s = 37.5 mm/s
  const FrameBlock frames = log.frames();
  EXPECT_EQ(detect(log, frames, 1000, {.max_speed_m_s = 0.0375}).summary.unplaced, 0u);
  EXPECT_GT(detect(log, frames, 1000, {.max_speed_m_s = 0.005}).summary.unplaced, 0u);
}

TEST(MissingEncoder, CountsALogWithoutPositions) {
  const SteppingLog log = one_run();
  FrameBlock frames = log.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) lose(frames, i);
  const auto found = detect(log, frames, 1000);
  EXPECT_TRUE(found.points.empty());
  EXPECT_EQ(found.summary.scans, 0u);
  EXPECT_EQ(found.summary.unplaced, frames.size());
}

// A NaN reading without a quality is missing, like a reading with the quality "missing".
TEST(MissingEncoder, ProbeWithUnmarkedNaNIsLost) {
  const SteppingLog log = one_run();
  FrameBlock frames = log.frames();
  frames.probe_m[1].assign(frames.size(), kNaN);
  const auto found = detect(log, frames, 1000);
  ASSERT_EQ(found.points.size(), 26u);
  for (const Point& p : found.points) {
    EXPECT_TRUE(has_flag(p, Flag::lost, "B"));
    EXPECT_TRUE(std::isfinite(p.probe_m[0]));
  }
}

TEST(MissingEncoder, RobustMeanOfNaNTerminates) {
  std::vector<double> scratch;
  for (const std::size_t bad : {1u, 50u, 51u, 99u, 100u}) {
    std::vector<double> readings(100, 1.0);
    std::fill_n(readings.begin(), bad, kNaN);
    robust_mean(readings, 0.1, scratch);  // must only terminate
  }
}

}  // namespace
}  // namespace mdof::algo
