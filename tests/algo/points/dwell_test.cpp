#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algo/points/dwell.h"
#include "algo/points/flags.h"
#include "algo/sequence/sequence.h"

namespace mdof::algo {
namespace {

// An axis that moves at `speed_m_s` and stops at each position. Its probe reads 1 µm per mm.
struct Stepper {
  double rate_hz = 1000, dwell_s = 0.5, speed_m_s = 0.02, noise_m = 10e-9;
  FrameBlock frames;
  double x = -1e-3;
  std::int64_t t_ns = 0;
  std::vector<std::int64_t> breaks;
  std::mt19937_64 rng{1};

  Stepper() {
    frames.probe_m.resize(1);
    frames.probe_quality.resize(1);
  }
  void scan() {
    std::normal_distribution<> unit;
    const auto gauss = [&](auto& r) { return noise_m * unit(r); };
    frames.time_ns.push_back(t_ns);
    frames.encoder_m.push_back(x + gauss(rng));
    frames.probe_m[0].push_back(1e-3 * x + gauss(rng));
    t_ns += static_cast<std::int64_t>(1e9 / rate_hz);
  }
  void move_to(double target) {
    const double step = speed_m_s / rate_hz;
    while (std::abs(target - x) > step) {
      x += target > x ? step : -step;
      scan();
    }
    x = target;
  }
  void dwell() {
    for (int i = 0; i < dwell_s * rate_hz; ++i) scan();
  }
  // The axis moves to `target` during a gap in the recording.
  void move_during_recording_gap(double target, double after_s) {
    breaks.push_back(t_ns - static_cast<std::int64_t>(1e9 / rate_hz));
    t_ns += static_cast<std::int64_t>(after_s * 1e9);
    x = target;
  }
  // Moves over the targets and back, n times, with an overrun beyond both ends.
  void passes(const std::vector<double>& targets, int n) {
    for (int k = 0; k < n; ++k) {
      for (const double t : targets) move_to(t), dwell();
      move_to(targets.back() + 1e-3);
      for (auto t = targets.rbegin(); t != targets.rend(); ++t) move_to(*t), dwell();
      move_to(targets.front() - 1e-3);
    }
  }
};

std::vector<Point> detect(const FrameBlock& frames, std::size_t block, DwellOptions options = {},
                          const std::vector<std::int64_t>& breaks = {}) {
  DwellDetector detector(options, {"A"}, {200e-6});
  for (const std::int64_t t : breaks) detector.break_after(t);
  std::vector<Point> points;
  for (std::size_t i = 0; i < frames.size(); i += block) {
    const std::size_t n = std::min(block, frames.size() - i);
    const auto cut = [&](const auto& c) {
      using Column = std::decay_t<decltype(c)>;
      if (c.empty()) return Column{};
      return Column(c.begin() + static_cast<std::ptrdiff_t>(i),
                    c.begin() + static_cast<std::ptrdiff_t>(i + n));
    };
    FrameBlock part{cut(frames.time_ns),
                    cut(frames.encoder_m),
                    {cut(frames.probe_m[0])},
                    {cut(frames.probe_quality[0])},
                    {}};
    if (!frames.probe_is_new.empty()) part.probe_is_new = {cut(frames.probe_is_new[0])};
    // The aligner omits the column if no row repeats a reading.
    for (auto& column : part.probe_is_new)
      if (std::find(column.begin(), column.end(), 0) == column.end()) column.clear();
    detector.push(part, points);
  }
  detector.flush(points);
  return points;
}

const std::vector<double> kTargets = {0, 2e-3, 4.1e-3, 5.9e-3, 8e-3};

TEST(Dwell, FindsEveryStopAndNoOther) {
  for (const double rate : {10.0, 20.0, 200.0, 1000.0, 4000.0}) {
    Stepper axis;
    axis.rate_hz = rate;
    if (rate < 80) axis.dwell_s = 2, axis.speed_m_s = 4e-3;  // at least four scans beyond an end
    axis.passes(kTargets, 2);
    const auto points = detect(axis.frames, 1000);
    ASSERT_EQ(points.size(), 20u) << rate;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point& p = points[i];
      EXPECT_EQ(p.direction, i % 10 < 5 ? 1 : -1) << rate << " " << i;
      EXPECT_NEAR(p.position_m, kTargets[i % 10 < 5 ? i % 5 : 4 - i % 5], 10e-9);
      EXPECT_NEAR(p.probe_m[0], 1e-3 * p.position_m, 10e-9);
      EXPECT_TRUE(p.flags.empty());
    }
  }
}

TEST(Dwell, GivesTheSameBitsForAnyBlockSize) {
  Stepper axis;
  axis.passes(kTargets, 1);
  const auto whole = detect(axis.frames, axis.frames.size());
  for (const std::size_t block : {1u, 17u, 1000u}) {
    const auto cut = detect(axis.frames, block);
    ASSERT_EQ(cut.size(), whole.size());
    for (std::size_t i = 0; i < cut.size(); ++i) {
      EXPECT_EQ(cut[i].position_m, whole[i].position_m);
      EXPECT_EQ(cut[i].probe_m, whole[i].probe_m);
      EXPECT_EQ(cut[i].probe_u_m, whole[i].probe_u_m);
      EXPECT_EQ(cut[i].begin_ns, whole[i].begin_ns);
    }
  }
}

// A replay has larger blocks than the live run. In a larger block, a later repeated reading adds
// the column of marks also for earlier rows, which had none.
TEST(Dwell, LearnsTheSameResolutionForAnyBlockSize) {
  constexpr double step_m = 100e-9;  // change of the reading in five rows of the motion
  Stepper axis;
  axis.noise_m = 1e-9;
  axis.passes(kTargets, 2);
  for (double& reading_m : axis.frames.probe_m[0])
    reading_m = step_m * std::round(reading_m / step_m);
  const std::size_t n = axis.frames.size();
  axis.frames.probe_is_new.assign(1, std::vector<std::uint8_t>(n, 1));
  axis.frames.probe_is_new[0][n - n / 4] = 0;
  const auto whole = detect(axis.frames, n);
  ASSERT_EQ(whole.size(), 20u);
  EXPECT_NEAR(whole[9].probe_u_m[0], step_m / std::sqrt(12), 1e-3 * step_m);
  for (const std::size_t block : {1u, 17u, 1000u}) {
    const auto cut = detect(axis.frames, block);
    ASSERT_EQ(cut.size(), whole.size());
    for (std::size_t i = 0; i < cut.size(); ++i)
      EXPECT_EQ(cut[i].probe_u_m, whole[i].probe_u_m) << i;
  }
}

TEST(Dwell, FollowsAnEncoderNoisierThanTheDefaultTolerance) {
  Stepper axis;
  axis.noise_m = 2e-6;
  axis.passes(kTargets, 1);
  EXPECT_EQ(detect(axis.frames, 1000).size(), 10u);
}

TEST(Dwell, ShortStopIsNoDwell) {
  Stepper axis;
  axis.dwell_s = 0.15;
  axis.passes(kTargets, 1);
  EXPECT_TRUE(detect(axis.frames, 1000).empty());
}

TEST(Dwell, CreepingAxisIsNoDwell) {
  Stepper axis;
  axis.noise_m = 0;
  axis.speed_m_s = 35e-6;  // 1.75 µm in the window, always within the tolerance
  axis.move_to(-0.9e-3);
  EXPECT_TRUE(detect(axis.frames, 1000).empty());
}

TEST(Dwell, FlagsGapsSpikesSaturationAndLoss) {
  Stepper axis;
  axis.passes(kTargets, 1);
  auto& f = axis.frames;
  const auto clean = detect(f, 1000);
  const auto inside = [&](std::size_t point, std::size_t offset) {
    const auto at = std::lower_bound(f.time_ns.begin(), f.time_ns.end(), clean[point].begin_ns);
    return static_cast<std::size_t>(at - f.time_ns.begin()) + offset;
  };
  f.probe_m[0][inside(1, 20)] += 25e-6;
  f.probe_quality[0].assign(f.size(), Quality::good);
  f.probe_quality[0][inside(2, 30)] = Quality::over_range;
  for (std::size_t i = 0; i < 400; ++i) {
    f.probe_quality[0][inside(3, i)] = Quality::missing;
    f.probe_m[0][inside(3, i)] = kNaN;
  }
  f.encoder_m[inside(4, 50)] += 1e-3;
  const auto gap = static_cast<std::ptrdiff_t>(inside(5, 40));
  for (auto* column : {&f.encoder_m, &f.probe_m[0]})
    column->erase(column->begin() + gap, column->begin() + gap + 10);
  f.time_ns.erase(f.time_ns.begin() + gap, f.time_ns.begin() + gap + 10);
  f.probe_quality[0].erase(f.probe_quality[0].begin() + gap, f.probe_quality[0].begin() + gap + 10);
  const auto points = detect(f, 1000);
  ASSERT_EQ(points.size(), 10u);
  EXPECT_TRUE(points[0].flags.empty());
  EXPECT_EQ(to_string(points[1].flags), "spike:A");
  EXPECT_EQ(to_string(points[2].flags), "saturated:A");
  EXPECT_EQ(to_string(points[3].flags), "lost:A");
  EXPECT_TRUE(std::isnan(points[3].probe_m[0]));
  EXPECT_EQ(to_string(points[4].flags), "spike:encoder");
  EXPECT_EQ(to_string(points[5].flags), "gap");
  for (const std::size_t i : {1u, 2u, 4u, 5u}) {
    EXPECT_NEAR(points[i].probe_m[0], clean[i].probe_m[0], 1e-9) << i;
    EXPECT_NEAR(points[i].position_m, clean[i].position_m, 2e-9) << i;
  }
}

TEST(Dwell, EncoderGlitchIsNoApproach) {
  Stepper axis;
  axis.passes(kTargets, 1);
  const auto clean = detect(axis.frames, 1000);
  const auto at = std::lower_bound(axis.frames.time_ns.begin(), axis.frames.time_ns.end(),
                                   clean[2].begin_ns + 150'000'000) -
                  axis.frames.time_ns.begin();
  for (const auto i : {at, at + 1, at + 2})
    axis.frames.encoder_m[static_cast<std::size_t>(i)] += 0.3e-3;
  const Sequence s = recognise_sequence(detect(axis.frames, 1000), {});
  ASSERT_EQ(s.points.size(), 10u);
  EXPECT_EQ(s.runs, 1);
  EXPECT_EQ(s.points[2].point.direction, 1);
}

// The axis moves and returns within two or three slots (quarters of the window). In two slots the
// motion is ignored. In three slots it is a motion, so the axis approaches the target from above.
TEST(Dwell, KnockOfTwoSlotsIsNoApproach) {
  for (const int length_ms : {14, 26}) {
    Stepper axis;
    axis.move_to(5e-3), axis.dwell();
    while (axis.t_ns % 12'500'000 != 0) axis.scan();
    axis.x += 0.3e-3;
    for (int i = 0; i < length_ms; ++i) axis.scan();
    axis.x -= 0.3e-3;
    axis.dwell();
    const auto points = detect(axis.frames, 1000);
    ASSERT_EQ(points.size(), 2u) << length_ms;
    EXPECT_EQ(points[0].direction, 1);
    EXPECT_EQ(points[1].direction, length_ms == 14 ? 1 : -1);
  }
}

// A probe is flagged as lost if it has readings in less than half of the scans of a stop.
TEST(Dwell, ProbeIsLostIfMostScansAreMissing) {
  for (const int good_per_ten : {4, 6}) {
    Stepper axis;
    axis.passes({0, 2e-3}, 1);
    auto& quality = axis.frames.probe_quality[0];
    for (std::size_t i = 0; i < axis.frames.size(); ++i)
      quality.push_back(static_cast<int>(i % 10) < good_per_ten ? Quality::good : Quality::missing);
    for (const Point& p : detect(axis.frames, 1000)) {
      EXPECT_EQ(std::isnan(p.probe_m[0]), good_per_ten == 4);
      EXPECT_EQ(to_string(p.flags), good_per_ten == 4 ? "lost:A" : "missing:A");
    }
  }
}

TEST(Dwell, TruncatesAnEndlessStop) {
  Stepper axis;
  axis.dwell_s = 60;
  axis.passes({0.0, 2e-3}, 1);
  DwellOptions options;
  options.max_scans = 10000;
  const auto points = detect(axis.frames, 1000, options);
  ASSERT_EQ(points.size(), 4u);
  for (const auto& p : points) {
    EXPECT_LE(p.samples, 11000u);
    EXPECT_TRUE(has_flag(p, Flag::truncated));
  }
}

TEST(Sequence, RecognisesTargetsRunsAndApproaches) {
  Stepper axis;
  axis.passes(kTargets, 3);
  const Sequence s = recognise_sequence(detect(axis.frames, 1000), {});
  EXPECT_EQ(s.targets, 5);
  EXPECT_EQ(s.runs, 3);
  ASSERT_EQ(s.points.size(), 30u);
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const std::size_t in_run = i % 10;
    EXPECT_EQ(s.points[i].run, static_cast<int>(i / 10) + 1);
    EXPECT_EQ(s.points[i].point.direction, in_run < 5 ? 1 : -1);
    EXPECT_EQ(s.points[i].target, static_cast<int>(in_run < 5 ? in_run + 1 : 10 - in_run));
  }
}

TEST(Sequence, MissedStopDoesNotShiftTheRuns) {
  Stepper axis;
  axis.passes(kTargets, 3);
  auto points = detect(axis.frames, 1000);
  points.erase(points.begin() + 12);  // target 3 of run 2, forward
  const Sequence s = recognise_sequence(points, {});
  EXPECT_EQ(s.points.back().run, 3);
  EXPECT_EQ(
      std::count_if(s.points.begin(), s.points.end(), [](const auto& p) { return p.run == 2; }), 9);
}

TEST(Sequence, OneWayPassesAreRuns) {
  Stepper axis;
  for (int k = 0; k < 3; ++k) {
    for (const double t : kTargets) axis.move_to(t), axis.dwell();
    axis.move_to(-1e-3);
  }
  const Sequence s = recognise_sequence(detect(axis.frames, 1000), {});
  ASSERT_EQ(s.points.size(), 15u);
  EXPECT_EQ(s.runs, 3);
  for (const auto& p : s.points) EXPECT_EQ(p.point.direction, 1);
}

TEST(Sequence, NominalTargetsLeaveOutOtherStops) {
  Stepper axis;
  axis.passes(kTargets, 1);
  SequenceOptions options;
  options.targets_m = {0, 4e-3, 8e-3};
  const Sequence s = recognise_sequence(detect(axis.frames, 1000), options);
  EXPECT_EQ(s.points.size(), 6u);
  EXPECT_EQ(s.left_out.size(), 4u);
  EXPECT_EQ(s.notices.size(), 1u);
  EXPECT_EQ(s.points[1].target_m, 4e-3);
}

TEST(Sequence, FirstStopTakesTheApproachOfTheNextMotion) {
  Stepper axis;
  axis.x = 0;
  for (const double t : kTargets) axis.move_to(t), axis.dwell();
  const Sequence s = recognise_sequence(detect(axis.frames, 1000), {});
  ASSERT_EQ(s.points.size(), 5u);
  EXPECT_EQ(s.points[0].point.direction, 1);
  EXPECT_EQ(to_string(s.points[0].point.flags), "approach_assumed");
  EXPECT_EQ(s.runs, 1);
}

// The axis moves forward to 4 mm. During a gap it moves to 8 mm and back to a stop at 6 mm.
TEST(Sequence, UnseenMotionIsNoApproach) {
  Stepper axis;
  for (const double t : {0.0, 2e-3, 4e-3}) axis.move_to(t), axis.dwell();
  axis.move_during_recording_gap(6e-3, 10);
  for (const double t : {6e-3, 4e-3, 2e-3}) axis.move_to(t), axis.dwell();
  const Sequence reported = recognise_sequence(detect(axis.frames, 1000, {}, axis.breaks), {});
  ASSERT_EQ(reported.points.size(), 6u);
  EXPECT_EQ(reported.points[2].point.direction, 1);
  EXPECT_TRUE(reported.points[2].point.flags.empty());
  EXPECT_EQ(reported.points[3].point.direction, -1);
  EXPECT_EQ(to_string(reported.points[3].point.flags), "approach_assumed");
  // The gap in the time stamps has the same effect as an announced break.
  const Sequence untold = recognise_sequence(detect(axis.frames, 1000), {});
  ASSERT_EQ(untold.points.size(), 6u);
  EXPECT_EQ(untold.points[3].point.direction, -1);
  EXPECT_EQ(to_string(untold.points[3].point.flags), "approach_assumed");
}

TEST(Sequence, StopWithARecordingGapCountsOnce) {
  for (const std::size_t block : {1u, 7u, 100000u}) {
    Stepper axis;
    for (const double t : {0.0, 2e-3, 4e-3}) axis.move_to(t), axis.dwell();
    axis.move_during_recording_gap(4e-3, 3600);
    axis.dwell_s = 1;
    axis.dwell();
    axis.move_to(2e-3);
    axis.dwell();
    const Sequence s = recognise_sequence(detect(axis.frames, block, {}, axis.breaks), {});
    ASSERT_EQ(s.points.size(), 4u);
    EXPECT_EQ(s.points[2].point.direction, 1);
    EXPECT_GT(s.points[2].point.samples, 700u);  // the samples of the longer part
    EXPECT_LT(s.points[2].point.samples, 1000u);
    EXPECT_EQ(to_string(s.points[2].point.flags), "approach_assumed interrupted");
    EXPECT_EQ(s.points[3].point.direction, -1);
  }
}

// A slow probe has a new reading every fourth row. The readings between them are interpolated.
TEST(Dwell, AveragesOnlyFreshReadings) {
  Stepper axis;
  axis.passes(kTargets, 1);
  axis.frames.probe_is_new.resize(1);
  for (std::size_t i = 0; i < axis.frames.size(); ++i) {
    axis.frames.probe_is_new[0].push_back(i % 4 == 0);
    axis.frames.probe_m[0][i] += i % 4 == 0 ? 0 : 3e-6;
  }
  const auto points = detect(axis.frames, 1000);
  ASSERT_EQ(points.size(), 10u);
  for (const auto& p : points) EXPECT_NEAR(p.probe_m[0], 1e-3 * p.position_m, 10e-9);
}

}  // namespace
}  // namespace mdof::algo
