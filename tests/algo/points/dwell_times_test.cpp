// Tests the begin and the end of a stop, and the counts in the summary of a log, for simulated
// logs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algo/points/frame_rows.h"
#include "tests/algo/stepping_axis.h"
#include "tests/algo/stepping_log.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr double kSlot_s = 0.0125;  // resolution of the detection, a quarter of the window

struct Found {
  std::vector<Point> points;
  DwellDetector::Summary summary;
  std::vector<DwellEvent> events;
};

Found found_in(const FrameBlock& frames, std::size_t block = 1'000'000, DwellOptions options = {}) {
  DwellDetector detector(options, {"A"}, {200e-6});
  Found found;
  for (std::size_t i = 0; i < frames.size(); i += block)
    detector.push(cut_frames(frames, i, std::min(frames.size(), i + block)), found.points);
  detector.flush(found.points);
  found.summary = detector.summary();
  found.events = detector.events();
  return found;
}

SteppingAxis fast_axis() {
  SteppingAxis axis;
  axis.rate_hz = 1000;
  return axis;
}

// The begin of a stop must be found within one slot. The averaged scans must end at most two slots
// before the end of the stop.
TEST(DwellTimes, MatchTheStop) {
  SteppingAxis axis = fast_axis();
  std::vector<double> begin_s, end_s;
  for (int i = 0; i < 25; ++i) {
    axis.move_to(1e-3 * (i % 7) + 0.13e-3 * i);
    begin_s.push_back(1e-9 * static_cast<double>(axis.t_ns));
    axis.wait(0.4 + 0.0007 * i);
    end_s.push_back(1e-9 * static_cast<double>(axis.t_ns));
  }
  axis.move_to(20e-3);
  const Found found = found_in(axis.frames);
  ASSERT_EQ(found.points.size(), 25u);
  double longest_s = 0;
  for (std::size_t i = 0; i < 25; ++i) {
    const double late_s = 1e-9 * static_cast<double>(found.points[i].begin_ns) - begin_s[i] - 0.1;
    const double early_s = end_s[i] - 1e-9 * static_cast<double>(found.points[i].end_ns);
    EXPECT_GE(late_s, -0.003) << i;
    EXPECT_LE(late_s, kSlot_s + 0.003) << i;
    EXPECT_GE(early_s, 0) << i;
    EXPECT_LE(early_s, 2 * kSlot_s + 0.003) << i;
    longest_s = std::max(longest_s, end_s[i] - begin_s[i]);
  }
  EXPECT_LE(found.summary.longest_still_s, longest_s);
  EXPECT_GE(found.summary.longest_still_s, longest_s - 3 * kSlot_s);
}

TEST(DwellTimes, FindsLongEnoughStopsAndReportsShorterOnes) {
  SteppingAxis axis = fast_axis();
  for (int i = 0; i < 6; ++i) {
    axis.move_to(30e-3 + 2e-3 * i);
    axis.wait(i % 2 ? 0.17 : 0.25);
  }
  axis.move_to(50e-3);
  const Found found = found_in(axis.frames);
  ASSERT_EQ(found.points.size(), 3u);
  ASSERT_EQ(found.summary.passed_over.size(), 3u);
  ASSERT_EQ(found.events.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double at_m = 30e-3 + 4e-3 * static_cast<double>(i);
    EXPECT_NEAR(found.points[i].position_m, at_m, 20e-9);
    const auto& passed = found.summary.passed_over[i];
    EXPECT_NEAR(passed.position_m, at_m + 2e-3, 1e-6);
    EXPECT_NEAR(passed.length_s, 0.17, 3 * kSlot_s);
    EXPECT_TRUE(passed.too_short);
    EXPECT_EQ(found.events[i].kind, DwellEventKind::short_stop);
    EXPECT_NEAR(found.events[i].position_m, at_m + 2e-3, 1e-6);
  }
}

// A filter calculates the readings of the last 60 ms of a stop also from readings of the next
// motion.
TEST(DwellTimes, LeavesOutTheEndOfAStop) {
  SteppingAxis axis = fast_axis();
  for (const double wait_s : {0.5, 0.25, 0.32, 0.5}) {
    axis.move_to(axis.x_m + 3e-3);
    axis.wait(wait_s);
  }
  axis.move_to(20e-3);
  const Found whole = found_in(axis.frames), cut = found_in(axis.frames, 7, {.leave_s = 0.06});
  ASSERT_EQ(whole.points.size(), 4u);
  ASSERT_EQ(cut.points.size(), 3u);  // 0.1 + 0.1 + 0.06 s are required; 0.25 s is too short
  ASSERT_EQ(cut.summary.passed_over.size(), 1u);
  EXPECT_TRUE(cut.summary.passed_over[0].too_short);
  for (const auto& [was, is] : {std::pair(0, 0), std::pair(2, 1), std::pair(3, 2)}) {
    const Point& a = whole.points[static_cast<std::size_t>(was)];
    const Point& b = cut.points[static_cast<std::size_t>(is)];
    EXPECT_EQ(b.begin_ns, a.begin_ns);
    EXPECT_NEAR(1e-9 * static_cast<double>(a.end_ns - b.end_ns), 0.06, 0.0011);
  }
}

// In a window of 50 ms, 100 µm/s is 5 µm, which is above the tolerance of 2 µm; 20 µm/s is 1 µm.
// Both directions are tested.
TEST(DwellTimes, SlowTravelIsNoStop) {
  for (const double speed_m_s : {100e-6, -100e-6, 20e-6, -20e-6}) {
    SteppingAxis axis = fast_axis();
    for (int i = 0; i < 2000; ++i) axis.x_m += speed_m_s / axis.rate_hz, axis.scan();
    const double still_s = found_in(axis.frames).summary.longest_still_s;
    EXPECT_EQ(still_s == 0, std::abs(speed_m_s) > 50e-6) << speed_m_s;
    EXPECT_EQ(still_s > 1.8, std::abs(speed_m_s) < 50e-6) << speed_m_s;
  }
}

// An axis that moves at 20 µm/s stays within the tolerance of 2 µm for 0.1 s.
TEST(DwellTimes, SlowTravelIsAtRestForTheTimeWithinTheTolerance) {
  SteppingAxis axis = fast_axis();
  for (int i = 0; i < 30000; ++i) axis.x_m += 0.02e-6, axis.scan();
  const Found found = found_in(axis.frames);
  EXPECT_TRUE(found.points.empty());
  EXPECT_NEAR(found.summary.longest_still_s, 0.1, 0.002);
}

// The axis creeps at 0.2 mm/s between fast motions. Up to 200 um this is a creeping stop. The
// detected stretch begins with the slot in which the creeping begins, and ends three slots before
// its end.
TEST(DwellTimes, CreepOverMoreThan200umIsTravel) {
  for (const int scans : {1000, 1100}) {  // 200 um and 220 um, detected as 190 um and 210 um
    SteppingAxis axis = fast_axis();
    axis.move_to(5e-3);
    for (int i = 0; i < scans; ++i) axis.x_m += 0.2e-6, axis.scan();
    axis.move_to(20e-3);
    axis.wait(0.4);
    const Found found = found_in(axis.frames);
    EXPECT_EQ(found.events.size(), scans == 1000 ? 1u : 0u) << scans;
  }
}

TEST(DwellTimes, SummaryCountsTheLog) {
  SteppingAxis axis = fast_axis();
  axis.noise_m = 0;
  for (const double at_m : {3e-3, -2e-3, 7e-3, 1e-3}) axis.stop(at_m);
  const Found found = found_in(axis.frames, 17);
  EXPECT_EQ(found.summary.scans, axis.frames.size());
  EXPECT_EQ(found.summary.gaps, 0u);
  EXPECT_EQ(found.summary.unplaced, 0u);
  EXPECT_NEAR(found.summary.encoder_min_m, -2e-3, 1e-9);
  EXPECT_NEAR(found.summary.encoder_max_m, 7e-3, 1e-9);
  EXPECT_DOUBLE_EQ(found.summary.period_s, 1e-3);
  EXPECT_DOUBLE_EQ(found.summary.tolerance_m, 2e-6);
}

TEST(DwellTimes, SummaryOfAnEmptyLogIsZero) {
  const DwellDetector::Summary none = found_in(SteppingAxis().frames).summary;
  EXPECT_EQ(none.scans + none.gaps + none.unplaced, 0u);
  EXPECT_EQ(none.encoder_min_m, 0);
  EXPECT_EQ(none.encoder_max_m, 0);
  EXPECT_EQ(none.period_s, 0);
  EXPECT_EQ(none.longest_still_s, 0);
  EXPECT_TRUE(none.passed_over.empty());
}

// The tolerance is six times the noise of the encoder, 1 um. The noise is determined with a
// resolution of an eighth of an octave.
TEST(DwellTimes, ToleranceIsSixTimesTheNoise) {
  SteppingAxis axis = fast_axis();
  axis.noise_m = 1e-6;
  for (int i = 0; i < 10; ++i) axis.stop(1e-3 * i);
  EXPECT_NEAR(found_in(axis.frames).summary.tolerance_m, 6e-6, 0.5e-6);
  DwellOptions given;
  given.tolerance_m = 3e-6;
  EXPECT_EQ(found_in(axis.frames, 100, given).summary.tolerance_m, 3e-6);
}

// Two missing scans make an interval of three periods, which is no gap. Three missing scans make a
// gap.
TEST(DwellTimes, GapIsLongerThanThreePeriods) {
  for (const std::size_t lost : {1u, 2u, 3u}) {
    SteppingAxis axis = fast_axis();
    axis.stop(2e-3);
    axis.move_to(5e-3);
    FrameBlock frames = axis.frames;
    const std::size_t row = 300;  // within a stop
    for (auto* column : {&frames.encoder_m, frames.probe_m.data()})
      column->erase(column->begin() + row, column->begin() + row + static_cast<int>(lost));
    frames.time_ns.erase(frames.time_ns.begin() + row,
                         frames.time_ns.begin() + row + static_cast<int>(lost));
    const Found found = found_in(frames);
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(has_flag(found.points[0], Flag::gap), lost == 3) << lost;
    EXPECT_EQ(found.summary.gaps, lost == 3 ? 1u : 0u) << lost;
  }
}

// The period is the median of the first 32 intervals. Later intervals and the block size have no
// effect.
TEST(DwellTimes, PeriodIsTheMedianOfTheFirstIntervals) {
  SteppingAxis axis;
  for (int i = 0; i < 500; ++i) axis.scan();
  std::int64_t t_ns = 0;
  for (std::size_t i = 0; i < axis.frames.size(); ++i) {
    axis.frames.time_ns[i] = t_ns;
    t_ns += i == 16 ? 1'100'000 : i < 32 && i % 2 == 0 ? 1'000'000 : i < 32 ? 1'200'000 : 1'500'000;
  }
  // 15 intervals of 1 ms, 16 of 1.2 ms and one of 1.1 ms. The median, the 17th of 32, is 1.2 ms.
  for (const std::size_t block : {1u, 33u, 40u, 1000u})
    EXPECT_DOUBLE_EQ(found_in(axis.frames, block).summary.period_s, 1.2e-3) << block;
  t_ns = 0;
  for (std::size_t i = 0; i < axis.frames.size(); ++i) {
    axis.frames.time_ns[i] = t_ns;
    t_ns += i % 2 == 0 && i < 32 ? 1'000'000 : i == 31 ? 1'100'000 : 1'300'000;
  }
  for (const std::size_t block : {1u, 33u, 40u, 1000u})
    EXPECT_DOUBLE_EQ(found_in(axis.frames, block).summary.period_s, 1.1e-3) << block;
}

// Each row is counted once, also if all time stamps are equal.
TEST(DwellTimes, RowsAtOneInstantAreCountedOnce) {
  SteppingAxis axis;
  for (int i = 0; i < 70; ++i) axis.scan();
  std::fill(axis.frames.time_ns.begin(), axis.frames.time_ns.end(), 5'000'000);
  EXPECT_EQ(found_in(axis.frames, 1).summary.scans, 70u);
}

TEST(DwellTimes, FindsAStopBeforeThePeriodIsKnown) {
  SteppingAxis axis;
  axis.rate_hz = 20;
  axis.wait(1.5);
  ASSERT_EQ(axis.frames.size(), 30u);
  for (const std::size_t block : {1u, 7u, 100u}) {
    const Found found = found_in(axis.frames, block);
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(found.summary.scans, 30u);
    EXPECT_NEAR(found.points[0].position_m, -1e-3, 20e-9);
  }
}

// The axis moves at 10 mm/s, and 1.5 s are missing. The event states the last position before the
// hole and the distance moved during the hole.
TEST(DwellTimes, HoleStatesTheLastScanBeforeIt) {
  FrameBlock frames = empty_frames(1);
  for (std::int64_t ms = 0; ms < 4000; ++ms) {
    if (ms > 1000 && ms < 2500) continue;
    frames.time_ns.push_back(ms * 1'000'000);
    frames.encoder_m.push_back(1e-5 * static_cast<double>(ms));
    frames.probe_m[0].push_back(0);
  }
  const Found found = found_in(frames);
  ASSERT_EQ(found.events.size(), 1u);
  const DwellEvent& hole = found.events[0];
  EXPECT_EQ(hole.kind, DwellEventKind::hole);
  EXPECT_EQ(hole.time_ns, 1'000'000'000);
  EXPECT_NEAR(hole.position_m, 10e-3, 1e-12);
  EXPECT_NEAR(hole.size_m, 15e-3, 1e-12);
  EXPECT_NEAR(hole.length_s, 1.5, 1e-12);
  EXPECT_EQ(found.summary.gaps, 1u);
  EXPECT_EQ(found.summary.scans, frames.size());
}

// Readings are NaN in a log without qualities. The other readings are averaged.
TEST(DwellTimes, LeavesOutNaNReadings) {
  SteppingAxis axis = fast_axis();
  for (int i = 0; i < 4; ++i) axis.stop(1e-3 * i);
  axis.move_to(9e-3);
  FrameBlock frames = axis.frames;
  for (auto& quality : frames.probe_quality) quality.clear();
  const Found whole = found_in(frames);
  for (std::size_t i = 40; i < frames.size(); i += 40) frames.probe_m[0][i] = std::nan("");
  const Found found = found_in(frames);
  ASSERT_EQ(found.points.size(), whole.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i)
    EXPECT_NEAR(found.points[i].probe_m[0], whole.points[i].probe_m[0], 2e-9) << i;
}

// A break that is announced too early takes effect at its time.
TEST(DwellTimes, BreakTakesEffectAtItsTime) {
  SteppingAxis axis = fast_axis();
  for (int i = 0; i < 3; ++i) axis.stop(1e-3 * i);
  const std::size_t before = axis.frames.size();
  const std::int64_t last_ns = axis.frames.time_ns.back();
  axis.t_ns += 50'000'000;
  for (int i = 3; i < 6; ++i) axis.stop(1e-3 * i);
  axis.move_to(9e-3);
  std::vector<Point> told[2];
  for (const bool early : {false, true}) {
    DwellDetector detector({}, {"A"}, {200e-6});
    std::vector<Point>& points = told[early ? 1 : 0];
    if (early) detector.break_after(last_ns);
    detector.push(cut_frames(axis.frames, 0, before), points);
    if (!early) detector.break_after(last_ns);
    detector.push(cut_frames(axis.frames, before, axis.frames.size()), points);
    detector.flush(points);
  }
  ASSERT_EQ(told[0].size(), 6U);
  ASSERT_EQ(told[1].size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(told[1][i].begin_ns, told[0][i].begin_ns) << i;
    EXPECT_EQ(told[1][i].end_ns, told[0][i].end_ns) << i;
    EXPECT_EQ(told[1][i].direction, told[0][i].direction) << i;
    EXPECT_EQ(to_string(told[1][i].flags), to_string(told[0][i].flags)) << i;
  }
}

// At 20 scans per second, a stop of less than 20 scans is shorter than what is always found. The
// notice states the scans per second.
TEST(DwellTimes, ReportsThatShortStopsMayBeMissed) {
  for (const double dwell_s : {0.9, 3.0}) {
    SteppingAxis axis;
    axis.rate_hz = 20;
    axis.dwell_s = dwell_s;
    axis.speed_m_s = 4e-3;
    for (int i = 0; i < 12; ++i) axis.stop(2e-3 * (i + 1));
    DwellDetector detector({}, {"A"}, {200e-6});
    std::vector<Point> points;
    detector.push(axis.frames, points);
    detector.flush(points);
    const Notices all = detector.notices(points);
    EXPECT_EQ(test::has(all, NoticeCode::stops_may_be_missed), dwell_s < 1) << points.size();
    for (const Notice& each : all)
      if (each.code == NoticeCode::stops_may_be_missed) {
        EXPECT_NEAR(test::number(each, "rate_hz"), 20, 1e-9);
        EXPECT_NEAR(test::number(each, "needed_s"), 1, 1e-9);
        EXPECT_EQ(test::number(each, "points"), static_cast<double>(points.size()));
      }
  }
}

}  // namespace
}  // namespace mdof::algo
