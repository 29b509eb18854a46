// Tests notices about constant signals on both sides of each limit, for stops that are defined by
// hand. Also tests the steps of an encoder. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algo/plausibility/encoder/encoder_jump.h"
#include "algo/plausibility/plausibility.h"
#include "schema/sample.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

using test::shown;

constexpr double kU_m = 1e-9;    // u of the mean of a stop; a change of 8 nm is within the noise
constexpr double kSd_m = 10e-9;  // standard deviation of single readings

Rig rig_of(std::size_t probes) {
  Rig rig;
  for (std::size_t k = 0; k < probes; ++k) {
    Probe probe;
    probe.id = std::string(1, static_cast<char>('A' + k));
    probe.range_m = 200e-6;
    rig.probes.push_back(probe);
  }
  return rig;
}

// Stops of 0.5 s in intervals of one second, at targets 1, 2, 3, ... The reading of each probe
// increases by 1 µm per stop.
Sequence stops_of(std::size_t probes, int n) {
  Sequence sequence;
  for (int i = 0; i < n; ++i) {
    MeasuredPoint p;
    p.target = i + 1;
    p.point.position_m = 1e-3 * i;
    p.point.begin_ns = 1'000'000'000LL * i;
    p.point.end_ns = p.point.begin_ns + 500'000'000;
    p.point.probe_m.assign(probes, 1e-6 * i);
    p.point.probe_sd_m.assign(probes, kSd_m);
    p.point.probe_u_m.assign(probes, kU_m);
    sequence.points.push_back(p);
  }
  return sequence;
}

Notices said(const Sequence& sequence, std::size_t probes = 5) {
  const Rig rig = rig_of(probes);
  const DwellDetector::Summary none;
  return signal_notices({rig, sequence, none});
}

// From stop `first` on, the reading of probe C is 3 µm.
Sequence with_dead_probe(int n, std::size_t first, double wobble_m = 0) {
  Sequence sequence = stops_of(5, n);
  for (std::size_t i = first; i < sequence.points.size(); ++i)
    sequence.points[i].point.probe_m[2] = 3e-6 + (i % 2 ? wobble_m : 0);
  return sequence;
}

TEST(Signals, CorrectRunHasNoNotices) {
  EXPECT_TRUE(said(stops_of(5, 20)).empty());
  EXPECT_TRUE(said(Sequence{}).empty());
}

TEST(Signals, ReportsAProbeThatNeverMoves) {
  const auto found = said(with_dead_probe(12, 0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(shown(found[0]), "probe_insensitive C stops=12 from_s=0 reading_um=3");
}

// The output of probe B is limited to 7.5 um. Three stops at different times have this reading,
// which is the highest or lowest reading.
TEST(Signals, ReportsAClippedAmplifier) {
  const auto clipped = [](const std::vector<std::size_t>& at, double reading_m, int n = 12) {
    Sequence sequence = stops_of(5, n);
    for (MeasuredPoint& p : sequence.points) p.point.probe_m[1] = 7e-6 * std::sin(p.target * 1.3);
    for (const std::size_t i : at) {
      sequence.points[i].point.probe_m[1] = reading_m;
      sequence.points[i].point.probe_sd_m[1] = 0;
    }
    return said(sequence);
  };
  for (const double reading_m : {7.5e-6, -7.5e-6}) {
    const auto found = clipped({2, 5, 9}, reading_m);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::doubtful);
    EXPECT_EQ(shown(found[0]), std::string("probe_clipped B stops=3 reading_um=") +
                                   (reading_m > 0 ? "7.5" : "-7.5"));
  }
  EXPECT_TRUE(clipped({2, 9}, 7.5e-6).empty());
  EXPECT_TRUE(clipped({2, 5, 9}, 1e-6).empty()) << "others read beyond";
  EXPECT_TRUE(clipped({0, 1, 2}, 7.5e-6, 3).empty()) << "no stop has noise";
}

// The resolution of the probe is coarser than its noise, so stops without scatter are normal.
TEST(Signals, ProbeWithCoarseResolutionIsNotClipped) {
  Sequence sequence = stops_of(5, 12);
  for (std::size_t i = 0; i < 12; ++i) {
    sequence.points[i].point.probe_m[1] =
        1e-6 * std::round(3 * std::sin(1.3 * static_cast<double>(i)));
    if (i % 3 != 0) sequence.points[i].point.probe_sd_m[1] = 0;
  }
  EXPECT_TRUE(said(sequence).empty());
}

TEST(Signals, ReportsWhenAProbeDies) {
  const auto found = said(with_dead_probe(12, 5));  // before stop 5 the probe reads 0 to 4 um
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(shown(found[0]), "probe_insensitive C stops=7 from_s=5 reading_um=3");
}

TEST(Signals, DeadProbeNeedsSixStopsAtThreePlaces) {
  EXPECT_EQ(said(with_dead_probe(12, 6)).size(), 1u);
  EXPECT_EQ(said(with_dead_probe(12, 7)).size(), 0u);   // five stops
  EXPECT_EQ(said(with_dead_probe(28, 21)).size(), 1u);  // a quarter of the stops
  EXPECT_EQ(said(with_dead_probe(32, 25)).size(), 0u);  // less than a quarter of the stops
  for (const int places : {2, 3}) {
    Sequence few = with_dead_probe(12, 0);
    for (std::size_t i = 0; i < few.points.size(); ++i)
      few.points[i].target = static_cast<int>(i) % places + 1;
    EXPECT_EQ(said(few).size(), places == 3 ? 1u : 0u) << places;
  }
}

TEST(Signals, ConstantMeansWithinEightTimesU) {
  EXPECT_EQ(said(with_dead_probe(12, 0, 7.9e-9)).size(), 1u);
  EXPECT_EQ(said(with_dead_probe(12, 0, 8.1e-9)).size(), 0u);
}

// The readings of the other probes, and of the probe itself before its fault, must have changed by
// 50 times the limit of 8 nm: 400 nm.
TEST(Signals, ReadingsOfOtherProbesMustChange) {
  for (const double step_m : {38e-9, 35e-9}) {  // 418 nm and 385 nm over eleven steps
    Sequence slow = with_dead_probe(12, 0);
    for (std::size_t i = 0; i < slow.points.size(); ++i)
      for (const std::size_t k : {0u, 1u, 3u, 4u})
        slow.points[i].point.probe_m[k] = -step_m * static_cast<double>(i);
    EXPECT_EQ(said(slow).size(), step_m > 37e-9 ? 1u : 0u) << step_m;
    Sequence before = with_dead_probe(12, 4);
    for (std::size_t i = 0; i < 4; ++i)
      before.points[i].point.probe_m[2] = 2e-6 - 10 * step_m * (i == 2) - 10 * step_m * (i == 3);
    before.points[3].point.probe_m[2] -= 0.7 * step_m;
    EXPECT_EQ(said(before).size(), step_m > 37e-9 ? 1u : 0u) << step_m;
  }
}

TEST(Signals, ReportsAProbeBeyondItsRange) {
  Sequence sequence = stops_of(5, 12);
  for (const std::size_t i : {2u, 3u, 7u})
    sequence.points[i].point.flags = {{Flag::saturated, "B"}, {Flag::lost, "B"}};
  sequence.points[4].point.flags = {{Flag::saturated, "B"}, {Flag::lost, "C"}};
  const auto found = said(sequence);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(shown(found[0]), "probe_beyond_range B points=3 of=12 range_um=200");
  for (MeasuredPoint& p : sequence.points)
    p.point.flags = {{Flag::saturated, "B"}, {Flag::lost, "B"}};
  const auto always = said(sequence);
  ASSERT_EQ(always.size(), 1u);
  EXPECT_EQ(shown(always[0]), "probe_saturated B range_um=200");
}

TEST(Signals, IgnoresStopsWithoutValue) {
  Sequence holes = with_dead_probe(14, 0);
  for (const std::size_t i : {0u, 3u, 13u}) holes.points[i].point.probe_m[2] = kNaN;
  holes.points[5].point.probe_m[0] = kNaN;
  const auto found = said(holes);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(test::number(found[0], "stops"), 11);
}

// At stop 4, the standard deviation of the first `restless` probes is `times` times the standard
// deviation at the other stops.
Sequence with_restless_stop(std::size_t probes, int stops, std::size_t restless, double times) {
  Sequence sequence = stops_of(probes, stops);
  for (std::size_t k = 0; k < restless; ++k) sequence.points[4].point.probe_sd_m[k] = times * kSd_m;
  return sequence;
}

TEST(Signals, ReportsAStopInWhichMostProbesChange) {
  const auto found = said(with_restless_stop(5, 12, 4, 40));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(shown(found[0]), "encoder_stood_still position_mm=4 length_s=0.5 changing=4 probes=5");
}

TEST(Signals, NeedsThreeProbesAndHalfOfThemAt30TimesSd) {
  EXPECT_EQ(said(with_restless_stop(5, 12, 3, 31)).size(), 1u);
  EXPECT_EQ(said(with_restless_stop(5, 12, 3, 29)).size(), 0u);
  EXPECT_EQ(said(with_restless_stop(5, 12, 2, 40)).size(), 0u);
  EXPECT_EQ(said(with_restless_stop(6, 12, 3, 40), 6).size(), 1u);
  EXPECT_EQ(said(with_restless_stop(7, 12, 3, 40), 7).size(), 0u);
  EXPECT_EQ(said(with_restless_stop(5, 6, 3, 40)).size(), 1u);
  // With fewer stops, the least sd is the reference: here two of five stops are restless.
  Sequence few = with_restless_stop(5, 5, 3, 40);
  EXPECT_EQ(said(few).size(), 1u);
  for (std::size_t k = 0; k < 3; ++k) few.points[1].point.probe_sd_m[k] = 40 * kSd_m;
  EXPECT_EQ(said(few).size(), 2u);
  EXPECT_EQ(said(with_restless_stop(5, 5, 3, 29)).size(), 0u);
  Sequence stepped = with_restless_stop(5, 12, 3, 40);
  for (std::size_t i = 0; i < 12; ++i)
    if (i != 4) stepped.points[i].point.probe_sd_m[0] = 0;  // an sd of 0 gives no information
  EXPECT_EQ(said(stepped).size(), 0u);
  Sequence unknown = with_restless_stop(5, 12, 4, 40);
  for (const std::size_t i : {1u, 2u, 7u}) unknown.points[i].point.probe_sd_m.assign(5, kNaN);
  unknown.points[9].point.probe_sd_m.clear();
  EXPECT_EQ(said(unknown).size(), 1u);
}

// An axis that moves by `speed_m` per scan of 1 ms, and by `step_m` more at row 30.
struct Rows {
  std::vector<std::int64_t> time_ns;
  std::vector<double> encoder_m;
};
Rows rows_of(double speed_m, double step_m) {
  Rows rows;
  for (int i = 0; i < 60; ++i) {
    rows.time_ns.push_back(1'000'000LL * i);
    rows.encoder_m.push_back(speed_m * i + (i >= 30 ? step_m : 0));
  }
  return rows;
}

std::optional<EncoderJump> jump_in(const Rows& rows, std::size_t first = 0, std::size_t last = 60,
                                   double least_m = 5e-6) {
  return find_jump(rows.time_ns, rows.encoder_m, first, last, 1'000'000, least_m);
}

TEST(EncoderJumpRule, FindsPositionTimeAndSizeOfAStep) {
  for (const double speed_m : {0.0, 20e-6, -20e-6}) {
    for (const double step_m : {100e-6, -100e-6, 6e-6}) {
      const auto jump = jump_in(rows_of(speed_m, step_m));
      ASSERT_TRUE(jump) << speed_m << " " << step_m;
      EXPECT_EQ(jump->time_ns, 30'000'000);
      EXPECT_NEAR(jump->position_m, speed_m * 29, 1e-12);
      EXPECT_NEAR(jump->size_m, step_m, 1e-12);
    }
  }
}

TEST(EncoderJumpRule, FindsNothingWithoutAJump) {
  EXPECT_FALSE(jump_in(rows_of(20e-6, 0)));
  EXPECT_FALSE(jump_in(rows_of(0, 4.9e-6)));  // below the limit
  EXPECT_FALSE(jump_in(rows_of(0, 100e-6), 31));
  EXPECT_FALSE(jump_in(rows_of(0, 100e-6), 0, 30));
  EXPECT_TRUE(jump_in(rows_of(0, 100e-6), 30, 31));
  // An acceleration of 10 m/s² over two scans of 1 ms moves the axis by 2.5 µm.
  EXPECT_FALSE(jump_in(rows_of(0, 2.4e-6), 0, 60, 1e-9));
  EXPECT_TRUE(jump_in(rows_of(0, 2.6e-6), 0, 60, 1e-9));
}

TEST(EncoderJumpRule, SpikeOfOneScanIsNoJump) {
  for (const int at : {20, 29, 30, 31, 33}) {
    Rows rows = rows_of(10e-6, 0);
    rows.encoder_m[static_cast<std::size_t>(at)] += 500e-6;
    EXPECT_FALSE(jump_in(rows)) << at;
    rows.encoder_m[static_cast<std::size_t>(at)] -= 1000e-6;
    EXPECT_FALSE(jump_in(rows)) << at;
  }
}

// The larger of two steps is returned. A step at a gap in time is ignored, because the axis may
// have moved during the gap.
TEST(EncoderJumpRule, FindsTheLargestStepOutsideGaps) {
  Rows two = rows_of(0, 60e-6);
  for (std::size_t i = 45; i < 60; ++i) two.encoder_m[i] -= 100e-6;
  EXPECT_EQ(jump_in(two)->time_ns, 45'000'000);
  for (std::size_t i = 45; i < 60; ++i) two.encoder_m[i] += 60e-6;
  EXPECT_EQ(jump_in(two)->time_ns, 30'000'000);
  for (const std::int64_t hole_ns : {2'900'000, 3'100'000}) {
    Rows hole = rows_of(0, 100e-6);
    for (std::size_t i = 30; i < 60; ++i) hole.time_ns[i] += hole_ns;
    EXPECT_EQ(jump_in(hole).has_value(), hole_ns < 3'000'000);
  }
}

// A sudden start of the axis is a change of speed and not a jump.
TEST(EncoderJumpRule, StartIsNoJump) {
  Rows rows = rows_of(0, 0);
  for (std::size_t i = 30; i < 60; ++i) rows.encoder_m[i] = 50e-6 * static_cast<double>(i - 29);
  EXPECT_FALSE(jump_in(rows));
}

}  // namespace
}  // namespace mdof::algo
