// Logs of an axis that moves forward and in reverse; its position over time is known. The tests
// check the statements, notices and points of a run in motion.
#include "algo/on_the_fly/on_the_fly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "algo/points/flags.h"
#include "algo/points/frame_rows.h"
#include "tests/algo/stepping_log.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr double kOut_m_s = 10e-3, kBack_m_s = 5e-3, kTravel_m = 20e-3;
constexpr double kWave_m = 8e-3, kHeight_m = 20e-6;
constexpr std::int64_t kFirst_ns = 7'000'000'000;

// A log of a steady motion forward and in reverse. The fields change the motion or the log.
struct MotionLog {
  double travel_m = kTravel_m;
  double stop_at_m = -1, stop_s = 0;  // a stop in the forward pass
  double delay_s = 0;                 // delay of the probe
  std::function<bool(std::int64_t ms)> scanned = [](std::int64_t) { return true; };

  double turned_s() const { return travel_m / kOut_m_s + stop_s; }
  double place_m(double t) const {
    if (t >= turned_s()) return travel_m - kBack_m_s * (t - turned_s());
    const double at_m = kOut_m_s * t;
    if (stop_at_m < 0 || at_m < stop_at_m) return at_m;
    return std::max(stop_at_m, kOut_m_s * (t - stop_s));
  }
  FrameBlock frames() const {
    FrameBlock frames = empty_frames(1);
    const auto end_ms = std::lround(1e3 * (turned_s() + travel_m / kBack_m_s));
    for (std::int64_t ms = 0; ms <= end_ms; ++ms) {
      if (!scanned(ms)) continue;
      const double t = 1e-3 * static_cast<double>(ms);
      frames.time_ns.push_back(kFirst_ns + ms * 1'000'000);
      frames.encoder_m.push_back(place_m(t));
      const double read_at_m = place_m(std::max(0.0, t - delay_s));
      frames.probe_m[0].push_back(kHeight_m * std::sin(2 * M_PI * read_at_m / kWave_m) +
                                  (ms % 2 == 0 ? 1e-9 : -1e-9));
    }
    return frames;
  }
};

OnTheFly measured(const MotionLog& log, const OnTheFlyOptions& options = {}) {
  OnTheFly found(TargetGrid(options, {}), {"A"}, {200e-6});
  const FrameBlock frames = log.frames();
  for (std::size_t i = 0; i < frames.size(); i += 700)
    EXPECT_TRUE(found.push(cut_frames(frames, i, std::min(frames.size(), i + 700))));
  found.flush();
  return found;
}

void expect_in(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

// The bins of 1 mm are at 1 to 19 mm in both directions. The mean speed is (10 + 5)/2 mm/s. Noise
// with at least two periods per bin has a frequency of 15 Hz: 2 * 7.5 mm/s / 1 mm.
TEST(OnTheFlyRun, StatesSpeedsBinsAndScatter) {
  const OnTheFly run = measured({});
  const std::string said = test::shown(run.statements());
  expect_in(said, "measured_on_the_fly passes=2 speed_mm_s=7.5 from_mm_s=5 to_mm_s=10 ");
  expect_in(said, " bin_mm=1 left_out=0 ");
  expect_in(said, " seen_mm=2.5\n");
  expect_in(said, " slowest_hz=15\n");
  expect_in(said, "delays_by_motion delays_us=A ");
  expect_in(test::shown(run.notices()), "speed_varies from_mm_s=5 to_mm_s=10\n");
  const Sequence sequence = run.sequence();
  EXPECT_EQ(sequence.targets, 19);
  EXPECT_EQ(sequence.runs, 1);
  ASSERT_EQ(sequence.points.size(), 38U);
  for (const MeasuredPoint& p : sequence.points) {
    EXPECT_EQ(p.run, 1);
    EXPECT_NEAR(p.target_m, 1e-3 * p.target, 1e-12);
    EXPECT_NEAR(p.point.probe_m[0], kHeight_m * std::sin(2 * M_PI * p.target_m / kWave_m), 20e-9);
  }
  EXPECT_TRUE(run.check_has_points());
  EXPECT_EQ(run.summary().gaps, 0U);
  EXPECT_EQ(run.summary().scans, MotionLog().frames().size());
  EXPECT_NEAR(run.summary().period_s, 1e-3, 1e-12);
  EXPECT_NEAR(run.summary().encoder_max_m, kTravel_m, 1e-9);
}

// The readings alternate by ±1 nm about the form, so the residuals of the parabola of a bin are
// about 1 nm.
TEST(OnTheFlyRun, ScatterMatchesTheReadings) {
  const OnTheFly run = measured({});
  double square = 0, n = 0;
  for (const PassBins& pass : run.passes())
    for (const BinPoint& bin : pass.bins) {
      square += bin.point.probe_sd_m[0] * bin.point.probe_sd_m[0];
      n += 1;
    }
  const double nm = 1e9 * std::sqrt(square / n);
  const std::string said = test::shown(run.statements());
  const auto at = said.find("motion_scatter scatter_nm=A ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(said.substr(at + 28)), nm, 0.006 * nm);
}

// The difference between forward and reverse readings is proportional to the delay times the sum of
// both speeds.
TEST(OnTheFlyRun, ReportsAnUndeclaredDelay) {
  const std::string said = test::shown(measured({.delay_s = 2e-3}).notices());
  expect_in(said, "reading_delayed A delay_ms=");
  const auto at = said.find("delay_ms=") + 9;
  EXPECT_NEAR(std::stod(said.substr(at)), 2, 0.05) << said;
  // The effect on a reading is proportional to the delay.
  const auto effect_nm = [](const std::string& notices) {
    return std::stod(notices.substr(notices.find("effect_nm=") + 10));
  };
  const std::string half_delay_notices = test::shown(measured({.delay_s = 1e-3}).notices());
  EXPECT_GT(effect_nm(said), 1);
  EXPECT_NEAR(effect_nm(said) / effect_nm(half_delay_notices), 2, 0.1)
      << said << half_delay_notices;
  EXPECT_EQ(test::shown(measured({}).notices()).find("reading_delayed"), std::string::npos);
}

// The axis stops for 0.3 s at 7 mm. The bin at 7 mm begins at 6.5 mm, 0.65 s after the start.
TEST(OnTheFlyRun, LeavesOutTheBinOfAStop) {
  const OnTheFly run = measured({.stop_at_m = 7e-3, .stop_s = 0.3});
  expect_in(test::shown(run.notices()), "bin_of_changing_speed position_mm=7 time_s=0.65");
  expect_in(test::shown(run.statements()), " left_out=1 ");
  EXPECT_EQ(run.sequence().points.size(), 37U);
}

// A stop in the first or last bin belongs to the acceleration or deceleration of the axis and is
// not reported. A stop in another bin is reported.
TEST(OnTheFlyRun, DoesNotReportAStopInTheOutermostBins) {
  for (const double at_mm : {1.0, 2.0, 18.0, 19.0}) {
    const OnTheFly run = measured({.stop_at_m = 1e-3 * at_mm, .stop_s = 0.3});
    EXPECT_EQ(run.sequence().points.size(), 37U) << at_mm;
    const bool is_bin_reported =
        test::shown(run.notices()).find("bin_of_changing") != std::string::npos;
    EXPECT_EQ(is_bin_reported, at_mm == 2 || at_mm == 18) << at_mm;
  }
}

// If a third of the scans is missing at the start of the bin at 12 mm, the bin has a gap. If two
// thirds are missing, the bin is left out.
TEST(OnTheFlyRun, LeavesOutABinWithoutScans) {
  const auto without = [](std::int64_t from_ms, std::int64_t to_ms) {
    return MotionLog{.scanned = [=](std::int64_t ms) { return ms < from_ms || ms >= to_ms; }};
  };
  const OnTheFly few = measured(without(1160, 1195));
  EXPECT_EQ(few.sequence().points.size(), 38U);
  EXPECT_EQ(few.summary().gaps, 1U);
  EXPECT_EQ(test::shown(few.notices()).find("bin_"), std::string::npos);
  const OnTheFly many = measured(without(1160, 1230));
  EXPECT_EQ(many.sequence().points.size(), 37U);
  expect_in(test::shown(many.notices()), "bin_with_gap position_mm=12 ");
}

// The range from 2 to 12 mm limits the targets. The passes are longer.
TEST(OnTheFlyRun, RangeDeterminesTheTargets) {
  OnTheFlyOptions options;
  options.from_mm = 2;
  options.to_mm = 12;
  options.interval_mm = 2.5;
  const Sequence sequence = measured({}, options).sequence();
  ASSERT_EQ(sequence.targets, 5);
  EXPECT_NEAR(sequence.targets_m.front(), 2e-3, 1e-12);
  EXPECT_NEAR(sequence.targets_m.back(), 12e-3, 1e-12);
}

TEST(OnTheFlyRun, ExplainsWhyThereIsNoPoint) {
  const Status too_short = measured({.travel_m = 0.8e-3}).check_has_points();
  ASSERT_FALSE(too_short);
  expect_in(too_short.error().message, "contains no complete bin of 1 mm around a target");
  OnTheFlyOptions fine;
  fine.interval_mm = 0.02;  // 2 and 4 scans per bin; kLeastReadingsPerBin + 1 are required
  const Status dense = measured({}, fine).check_has_points();
  ASSERT_FALSE(dense);
  expect_in(dense.error().message, "and 1000 Hz, a bin of 0.02 mm has ");
}

// The axis stops for 0.5 s between the bins and moves 1 mm in 5 ms from stop to stop. A bin has two
// or three scans. At the mean speed of 2 mm/s, a bin of 0.5 mm would have 250 scans.
TEST(OnTheFlyRun, SuggestsReplayWithStopsForALogWithStops) {
  FrameBlock frames = empty_frames(1);
  for (std::int64_t ms = 0; ms < 20 * 505; ++ms) {
    const std::int64_t stop = ms / 505, moving_ms = std::max<std::int64_t>(ms % 505 - 500, 0);
    frames.time_ns.push_back(kFirst_ns + ms * 1'000'000);
    frames.encoder_m.push_back(
        1e-3 * (static_cast<double>(stop) + 0.5 + 0.2 * static_cast<double>(moving_ms)));
    frames.probe_m[0].push_back(ms % 2 == 0 ? 1e-9 : -1e-9);
  }
  OnTheFlyOptions options;
  options.bin_mm = 0.5;
  OnTheFly run(TargetGrid(options, {}), {"A"}, {200e-6});
  ASSERT_TRUE(run.push(frames));
  run.flush();
  const Status why = run.check_has_points();
  ASSERT_FALSE(why);
  EXPECT_EQ(why.error().remedy, Remedy::replay_with_stops) << why.error().message;
}

// 100 mm/s and 500 Hz, with a pause of 1 s at both ends. The remedy must not depend on the pauses.
TEST(OnTheFlyRun, TheSuggestedBinIsLargeEnough) {
  FrameBlock frames = empty_frames(1);
  for (std::int64_t i = 0; i < 1600; ++i) {
    const double s = 0.002 * static_cast<double>(i % 800) - 1;  // each pass takes 0.6 s
    const double way_m = 0.1 * std::clamp(s, 0.0, 0.6);
    frames.time_ns.push_back(kFirst_ns + i * 2'000'000);
    frames.encoder_m.push_back(i < 800 ? way_m : 0.06 - way_m);
    frames.probe_m[0].push_back(i % 2 == 0 ? 1e-9 : -1e-9);
  }
  const auto measured_with = [&](double bin_mm) {
    OnTheFlyOptions options;
    options.interval_mm = options.bin_mm = bin_mm;
    auto run = std::make_unique<OnTheFly>(TargetGrid(options, {}), std::vector<std::string>{"A"},
                                          std::vector<double>{200e-6});
    EXPECT_TRUE(run->push(frames));
    run->flush();
    return run;
  };
  const Status small = measured_with(1)->check_has_points();
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().remedy, Remedy::larger_bins);
  const auto run = measured_with(std::stod(small.error().remedy_for));
  EXPECT_TRUE(run->check_has_points()) << small.error().remedy_for;
  EXPECT_GT(run->sequence().points.size(), 50U);
}

// The readings are rounded to steps of 0.5 µm and repeat over several rows. u is the standard
// uncertainty of a rectangular distribution, 0.5 µm/√12.
TEST(OnTheFlyRun, LearnsTheResolutionOfTheProbe) {
  const MotionLog log;
  FrameBlock frames = log.frames();
  for (double& reading_m : frames.probe_m[0]) reading_m = 0.5e-6 * std::round(reading_m / 0.5e-6);
  OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
  ASSERT_TRUE(run.push(frames));
  run.flush();
  const Sequence sequence = run.sequence();
  ASSERT_EQ(sequence.points.size(), 38U);
  std::size_t rectangle_u_count = 0;
  for (const MeasuredPoint& p : sequence.points)
    rectangle_u_count += p.point.probe_u_m[0] > 0.5e-6 / std::sqrt(12.0) ? 1 : 0;
  EXPECT_GT(rectangle_u_count, 30U);
}

// Forward the axis moves 20 mm in 2 s, in reverse in 4 s, from -50 mm on. The mean speed is 40 mm /
// 6 s.
TEST(OnTheFlyRun, ExplanationStatesTheMeanSpeed) {
  OnTheFlyOptions fine;
  fine.bin_mm = 0.02;
  FrameBlock frames = MotionLog().frames();
  for (double& x : frames.encoder_m) x -= 50e-3;
  OnTheFly run(TargetGrid(fine, {}), {"A"}, {200e-6});
  ASSERT_TRUE(run.push(frames));
  run.flush();
  const Status why = run.check_has_points();
  ASSERT_FALSE(why);
  expect_in(why.error().message, "at 6.6");
  expect_in(why.error().message, "mm/s and 1000 Hz, a bin of 0.02 mm has 3");
}

// The forward pass has one gap, before the scan period is known; the reverse pass has two gaps.
TEST(OnTheFlyRun, CountsTheGapsOfEveryPass) {
  const OnTheFly run = measured({.scanned = [](std::int64_t ms) {
    for (const std::int64_t begin : {1160, 3000, 4000})
      if (ms >= begin && ms < begin + 35) return false;
    return ms % 1000 != 500;  // one missing scan is no gap
  }});
  EXPECT_EQ(run.summary().gaps, 3U);
}

// From 8 mm on, the reading of the probe is constant. Before, it changes with each scan.
TEST(OnTheFlyRun, FlagsPointsOfAFrozenProbe) {
  FrameBlock frames = MotionLog().frames();
  for (std::size_t i = 800; i < frames.size(); ++i) frames.probe_m[0][i] = frames.probe_m[0][800];
  OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
  ASSERT_TRUE(run.push(frames));
  run.flush();
  std::size_t flagged = 0;
  for (const MeasuredPoint& p : run.sequence().points) {
    const bool frozen = has_flag(p.point, Flag::frozen, "A");
    EXPECT_FALSE(frozen && p.point.direction > 0 && p.target < 8) << p.target;
    flagged += frozen ? 1 : 0;
  }
  EXPECT_GT(flagged, 28U);
}

// The bins are 0.5 mm long, with one bin per millimetre. The gap from 11.2 mm to 11.75 mm is
// between the bins at 11 and 12 mm.
TEST(OnTheFlyRun, GapBetweenTwoBinsFlagsNeither) {
  OnTheFlyOptions options;
  options.bin_mm = 0.5;
  const OnTheFly run =
      measured({.scanned = [](std::int64_t ms) { return ms < 1126 || ms > 1175; }}, options);
  EXPECT_EQ(run.summary().gaps, 1U);
  for (const MeasuredPoint& p : run.sequence().points)
    EXPECT_FALSE(has_flag(p.point, Flag::gap)) << p.target;
}

// The same motion, shifted by 30 mm and by -50 mm. The distances between the bins are unchanged.
TEST(OnTheFlyRun, FindsTheEndsOfTravelAtAnyOffset) {
  for (const double off_m : {30e-3, -50e-3}) {
    OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
    FrameBlock frames = MotionLog().frames();
    for (double& x : frames.encoder_m) x += off_m;
    EXPECT_TRUE(run.push(frames));
    run.flush();
    EXPECT_NEAR(run.summary().encoder_min_m, off_m, 1e-9);
    EXPECT_NEAR(run.summary().encoder_max_m, off_m + kTravel_m, 1e-9);
    EXPECT_EQ(run.sequence().cycle, Cycle::standard);
    EXPECT_TRUE(run.sequence().by_passes);
  }
}

// The first row has a position 5 m away, and three rows have no position.
TEST(OnTheFlyRun, CountsRowsWithoutPosition) {
  OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
  FrameBlock frames = MotionLog().frames();
  frames.encoder_m[0] = 5;
  for (const std::size_t i : {500U, 901U, 902U}) frames.encoder_m[i] = NAN;
  EXPECT_TRUE(run.push(frames));
  run.flush();
  EXPECT_EQ(run.summary().unplaced, 4U);
  EXPECT_EQ(run.summary().scans, frames.size() - 4);
  EXPECT_NEAR(run.summary().encoder_max_m, kTravel_m, 1e-9);
}

// A gap is longer than three scan periods: three missing scans are a gap, two are not. The log has
// three gaps: its first interval, one in the forward pass and one in the reverse pass.
TEST(OnTheFlyRun, GapIsLongerThanThreePeriods) {
  const OnTheFly run = measured({.scanned = [](std::int64_t ms) {
    return !(ms >= 1 && ms < 4) && !(ms >= 601 && ms < 603) && !(ms >= 1201 && ms < 1204) &&
           !(ms >= 3601 && ms < 3603) && !(ms >= 4601 && ms < 4604);
  }});
  EXPECT_EQ(run.summary().gaps, 3U);
}

// The axis moves from each position in `ends_mm` to the next at 10 mm/s, with one bin per
// millimetre. In the first log two of five passes cross the targets from 1 to 7 mm, in the second
// log two of four.
TEST(OnTheFlyRun, TargetNeedsHalfOfThePasses) {
  const auto sequence_over = [](const std::vector<double>& ends_mm) {
    FrameBlock frames = empty_frames(1);
    std::int64_t ms = 0;
    for (std::size_t k = 0; k + 1 < ends_mm.size(); ++k) {
      const double way_mm = ends_mm[k + 1] - ends_mm[k];
      const auto rows = std::lround(std::abs(way_mm) * 100);
      for (std::int64_t i = 0; i < rows; ++i, ++ms) {
        const double at_m = 1e-3 * (ends_mm[k] + way_mm * static_cast<double>(i) / rows);
        frames.time_ns.push_back(kFirst_ns + ms * 1'000'000);
        frames.encoder_m.push_back(at_m);
        frames.probe_m[0].push_back(1e-3 * at_m + (ms % 2 == 0 ? 1e-9 : -1e-9));
      }
    }
    OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
    EXPECT_TRUE(run.push(frames));
    run.flush();
    return run.sequence();
  };
  const Sequence few = sequence_over({20, 0, 20, 8, 20, 8});
  EXPECT_NEAR(few.targets_m.front(), 9e-3, 1e-12);
  EXPECT_EQ(few.targets, 11);
  ASSERT_EQ(few.left_out.size(), 16U);
  EXPECT_NEAR(few.left_out[1].position_m, 7e-3, 1e-5);  // the bin after 8 mm, where the axis turned
  EXPECT_EQ(few.points.size(), 55U);
  const Sequence half = sequence_over({20, 0, 20, 8, 20});
  EXPECT_NEAR(half.targets_m.front(), 1e-3, 1e-12);
  EXPECT_TRUE(half.left_out.empty());
}

}  // namespace
}  // namespace mdof::algo
