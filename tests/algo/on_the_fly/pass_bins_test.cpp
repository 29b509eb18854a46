// Bins of passes. The position over time is a known function.
#include "algo/on_the_fly/pass_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "algo/points/frame_rows.h"

namespace mdof::algo {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

// A pass with one probe. `place_m`: position in m at a time in s. `reading_m`: reading in m at a
// position in m. The pass has a row at each whole ms for which `scanned` is true.
FrameBlock simulated_pass(double seconds, const std::function<double(double)>& place_m,
                          const std::function<bool(std::int64_t)>& scanned,
                          const std::function<double(double)>& reading_m) {
  FrameBlock frames = empty_frames(1);
  for (std::int64_t ms = 0; ms < static_cast<std::int64_t>(1000 * seconds); ++ms) {
    if (!scanned(ms)) continue;
    frames.time_ns.push_back(5'000'000'000 + ms * kPeriod_ns);
    frames.encoder_m.push_back(place_m(1e-3 * static_cast<double>(ms)));
    frames.probe_m[0].push_back(reading_m(frames.encoder_m.back()));
  }
  return frames;
}

bool each(std::int64_t) {
  return true;
}
double nothing(double) {
  return 0;
}

// Bins of a pass with targets at 5 and 10 mm and bins of 1 mm.
PassBins found_in(const FrameBlock& frames, int direction) {
  OnTheFlyOptions options;
  options.interval_mm = 0;
  options.bin_mm = 1;
  return bins_of({frames, 0, frames.size(), direction}, TargetGrid(options, {5e-3, 10e-3}),
                 {{"A"}, {200e-6}, {0}}, kPeriod_ns);
}

TEST(PassBins, SpeedIsCorrectWithAndWithoutMissingScans) {
  const auto gaps = [](std::int64_t ms) { return ms % 7 != 0 && ms % 50 > 12; };
  for (const int direction : {1, -1})
    for (const bool some_are_missing : {false, true}) {
      const auto frames = simulated_pass(
          1.5, [&](double t) { return direction > 0 ? 10e-3 * t : 15e-3 - 10e-3 * t; },
          some_are_missing ? gaps : each, [](double x) { return 4e-6 + 2e-3 * x; });
      const PassBins bins = found_in(frames, direction);
      EXPECT_EQ(bins.direction, direction);
      EXPECT_EQ(bins.begin_ns, frames.time_ns.front());
      EXPECT_EQ(bins.end_ns, frames.time_ns.back());
      EXPECT_EQ(bins.from_m, frames.encoder_m.front());
      EXPECT_EQ(bins.to_m, frames.encoder_m.back());
      EXPECT_FALSE(bins.too_dense);
      ASSERT_EQ(bins.bins.size(), 2U);
      for (std::size_t i = 0; i < 2; ++i) {
        const BinPoint& bin = bins.bins[i];
        const double target_m = (i == 0) == (direction > 0) ? 5e-3 : 10e-3;
        EXPECT_NEAR(bin.speed_m_s, 10e-3, 1e-12);
        EXPECT_EQ(bin.point.position_m, target_m);
        EXPECT_EQ(bin.point.direction, direction);
        EXPECT_NEAR(bin.point.probe_m[0], 4e-6 + 2e-3 * target_m, 1e-15);
        EXPECT_NEAR(bin.slope[0], 2e-3, 1e-12);
        if (some_are_missing) continue;
        EXPECT_NEAR(static_cast<double>(bin.point.samples), 101, 1);  // the two ends are rounded
        EXPECT_NEAR(1e-9 * static_cast<double>(bin.point.end_ns - bin.point.begin_ns), 0.1, 2e-3);
      }
    }
}

// With a constant acceleration a, the positions during the time T of a bin deviate from a straight
// line by the rms a T²/(12 √5). The limit is 0.75 % of the bin.
TEST(PassBins, LeavesOutAnAccelerationAboveTheLimit) {
  const double speed = 10e-3, T = 0.1;
  const double limit = 0.0075 * 1e-3 * 12 * std::sqrt(5.0) / (T * T);
  for (const double share : {0.9, 1.1}) {
    const auto frames = simulated_pass(
        1.2,
        [&](double t) {
          return 5e-3 + speed * (t - 0.5) + share * limit * (t - 0.5) * (t - 0.5) / 2;
        },
        each, nothing);
    const PassBins found = found_in(frames, 1);
    ASSERT_FALSE(found.bins.empty() && found.left_out.empty());
    if (share < 1) {
      ASSERT_FALSE(found.bins.empty());
      EXPECT_EQ(found.bins.front().point.position_m, 5e-3);
      EXPECT_NEAR(found.bins.front().speed_m_s, speed, 1e-4);
    } else {
      ASSERT_FALSE(found.left_out.empty());
      const BinLeftOut& left = found.left_out.front();
      EXPECT_EQ(left.fault, BinFault::speed_changes);
      EXPECT_EQ(left.position_m, 5e-3);
      EXPECT_NEAR(left.speed_m_s, speed, 1e-4);
      EXPECT_NEAR(static_cast<double>(left.scans), 101, 3);
      EXPECT_NEAR(1e-9 * static_cast<double>(left.begin_ns), 5.45, 5e-3);
    }
  }
}

// The noise of the encoder is not a change of the speed. Its size follows from the second
// differences.
TEST(PassBins, EncoderNoiseIsNoChangeOfSpeed) {
  std::uint32_t state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return (static_cast<double>(state >> 8) / 16777216.0 - 0.5) * std::sqrt(12.0);
  };
  const auto frames = simulated_pass(
      1.2, [&](double t) { return 10e-3 * t + 12e-6 * noise(); }, each, nothing);
  const PassBins found = found_in(frames, 1);
  EXPECT_EQ(found.bins.size() + found.left_out.size(), 2U);
  EXPECT_EQ(found.bins.size(), 2U);
}

TEST(PassBins, ReportsTooFewScansAndGaps) {
  const auto way = [](double t) { return 10e-3 * t; };
  const auto at = [](std::int64_t from, std::int64_t to) {
    return [=](std::int64_t ms) { return ms < from || ms >= to; };
  };
  // 60 of 101 scans are missing.
  auto found = found_in(simulated_pass(1.2, way, at(460, 520), nothing), 1);
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(found.left_out[0].fault, BinFault::gap);
  EXPECT_EQ(found.left_out[0].position_m, 5e-3);
  EXPECT_NEAR(static_cast<double>(found.left_out[0].scans), 41, 1);
  found =
      found_in(simulated_pass(1.2, way, at(460, 500), nothing), 1);  // 40 of 101 scans are missing
  ASSERT_EQ(found.bins.size(), 2U);
  EXPECT_EQ(to_string(found.bins[0].point.flags), "gap");
  EXPECT_TRUE(found.bins[1].point.flags.empty());
  // A bin has 5 or 6 scans at 0.2 m/s.
  found = found_in(simulated_pass(
                       0.1, [](double t) { return 0.2 * t; }, each, nothing),
                   1);
  ASSERT_EQ(found.left_out.size(), 2U);
  EXPECT_EQ(found.left_out[0].fault, BinFault::too_few);
}

// Rows between the readings of a slow probe are interpolated and give no information. A missing row
// is flagged.
TEST(PassBins, FitOnlyFreshReadings) {
  auto frames = simulated_pass(
      1.2, [](double t) { return 10e-3 * t; }, each, [](double x) { return 1e-6 + 2e-3 * x; });
  frames.probe_is_new.assign(1, std::vector<std::uint8_t>(frames.size(), 1));
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (i % 3 != 0) {
      frames.probe_is_new[0][i] = 0;
      frames.probe_m[0][i] += 5e-6;
    }
  PassBins found = found_in(frames, 1);
  ASSERT_EQ(found.bins.size(), 2U);
  for (const BinPoint& bin : found.bins) {
    EXPECT_NEAR(bin.point.probe_m[0], 1e-6 + 2e-3 * bin.point.position_m, 1e-14);
    EXPECT_NEAR(bin.slope[0], 2e-3, 1e-10);
    EXPECT_TRUE(bin.point.flags.empty());
  }
  // The rows from 450 to 550 ms belong to the first bin. First one row is over the range, then
  // the reading of another row is missing, too.
  frames.probe_quality.assign(1, std::vector<Quality>(frames.size(), Quality::good));
  frames.probe_quality[0][480] = Quality::over_range;
  found = found_in(frames, 1);
  EXPECT_EQ(to_string(found.bins[0].point.flags), "saturated:A");
  EXPECT_TRUE(found.bins[1].point.flags.empty());
  frames.probe_m[0][481] = std::nan("");
  found = found_in(frames, 1);
  EXPECT_EQ(to_string(found.bins[0].point.flags), "saturated:A missing:A");
  EXPECT_FALSE(std::isnan(found.bins[0].point.probe_m[0]));
  frames.probe_quality[0][490] = Quality::over_range;  // two of 101 rows are over the range
  found = found_in(frames, 1);
  EXPECT_EQ(to_string(found.bins[0].point.flags), "saturated:A lost:A");
  EXPECT_TRUE(std::isnan(found.bins[0].point.probe_m[0]));
  for (std::size_t i = 460; i < 530; ++i) frames.probe_m[0][i] = std::nan("");
  found = found_in(frames, 1);
  EXPECT_EQ(to_string(found.bins[0].point.flags.back()), "lost:A");
  EXPECT_TRUE(std::isnan(found.bins[0].point.probe_m[0]));
  EXPECT_TRUE(std::isnan(found.bins[0].point.probe_u_m[0]));
  EXPECT_TRUE(std::isnan(found.bins[0].slope[0]));
  EXPECT_FALSE(std::isnan(found.bins[1].point.probe_m[0]));
}

// The bin at 5 mm is from 450 to 550 ms. A gap of ten scans before the bin does not flag it.
TEST(PassBins, GapFlagsOnlyItsBin) {
  const auto flags_of = [](std::int64_t from_ms, std::int64_t to_ms) {
    const auto frames = simulated_pass(
        1.5, [](double t) { return 10e-3 * t; },
        [&](std::int64_t ms) { return ms < from_ms || ms >= to_ms; }, nothing);
    const PassBins bins = found_in(frames, 1);
    EXPECT_EQ(bins.bins.size(), 2u) << from_ms;
    return bins.bins.empty() ? "no bin" : to_string(bins.bins[0].point.flags);
  };
  const std::string none, gap = "gap";
  EXPECT_EQ(flags_of(440, 449), none);
  EXPECT_EQ(flags_of(552, 560), none);
  EXPECT_EQ(flags_of(470, 480), gap);
  EXPECT_EQ(flags_of(470, 472), none);  // three scan periods are no gap
}

// With two scans at the ends of a bin, the interval between them is a gap. One scan in a bin is too
// few.
TEST(PassBins, TwoScansAtTheEndsLeaveAGap) {
  for (const bool both : {true, false}) {
    const auto frames = simulated_pass(
        1.5, [](double t) { return 10e-3 * t; },
        [&](std::int64_t ms) { return ms < 440 || ms > 560 || ms == 455 || (both && ms == 545); },
        nothing);
    const PassBins bins = found_in(frames, 1);
    ASSERT_EQ(bins.left_out.size(), 1u);
    EXPECT_EQ(bins.left_out[0].position_m, 5e-3);
    EXPECT_EQ(bins.left_out[0].fault, both ? BinFault::gap : BinFault::too_few);
  }
}

}  // namespace
}  // namespace mdof::algo
