// A sequence to which stops are appended one by one must equal the sequence of the whole log. The
// test records target, run and direction of each stop.
#include "algo/sequence/sequence_tail.h"

#include <gtest/gtest.h>

#include "tests/algo/stepping_log.h"

namespace mdof::algo {
namespace {

struct Placed {
  int target, run, direction;
};

// The axis moves over the targets and back, beyond both ends, `runs` times. Each stop has the range
// of the motion before it.
struct Walk {
  std::vector<Point> stops;
  std::vector<Placed> truth;
  double at_m = -1e-3;
  std::int64_t t_ns = 0;

  void stop(double to_m, int target, int run) {
    Point p;
    p.begin_ns = t_ns += 1'000'000'000;
    p.end_ns = p.begin_ns + 300'000'000;
    p.position_m = to_m;
    p.direction = to_m > at_m ? 1 : -1;
    p.travel_min_m = std::min(at_m, to_m);
    p.travel_max_m = std::max(at_m, to_m);
    p.samples = 300;
    at_m = to_m;
    truth.push_back({target, run, p.direction});
    stops.push_back(p);
  }
  void standard(int targets, double pitch_m, int runs) {
    for (int run = 1; run <= runs; ++run) {
      for (int i = 0; i < targets; ++i) stop(i * pitch_m, i + 1, run);
      at_m = targets * pitch_m;
      for (int i = targets - 1; i >= 0; --i) stop(i * pitch_m, i + 1, run);
      at_m = -pitch_m;
    }
  }
};

Sequence grown(const std::vector<Point>& stops, std::size_t whole, const SequenceOptions& options) {
  const auto middle = stops.begin() + static_cast<std::ptrdiff_t>(whole);
  Sequence sequence = recognise_sequence({stops.begin(), middle}, options);
  SequenceTail tail(sequence, options);
  for (auto stop = middle; stop != stops.end(); ++stop) {
    const std::size_t first = tail.append(*stop, sequence);
    EXPECT_LE(first, sequence.points.size());
    EXPECT_GE(first + 2, sequence.points.size());
  }
  return sequence;
}

void expect_equal_sequences(const Sequence& grown, const Sequence& whole) {
  ASSERT_EQ(grown.points.size(), whole.points.size());
  EXPECT_EQ(grown.targets_m, whole.targets_m);
  EXPECT_EQ(grown.runs, whole.runs);
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const MeasuredPoint &a = grown.points[i], &b = whole.points[i];
    ASSERT_EQ(a.target, b.target) << i;
    ASSERT_EQ(a.target_m, b.target_m) << i;
    ASSERT_EQ(a.run, b.run) << i;
    ASSERT_EQ(a.point.direction, b.point.direction) << i;
    ASSERT_EQ(a.point.flags, b.point.flags) << i;
    ASSERT_EQ(a.point.samples, b.point.samples) << i;
  }
}

TEST(SequenceTail, FindsTargetRunAndDirectionOfEachStop) {
  Walk walk;
  walk.standard(21, 5e-3, 24);
  for (const std::size_t whole : {100u, 256u, 301u}) {
    const Sequence sequence = grown(walk.stops, whole, {});
    ASSERT_EQ(sequence.points.size(), walk.truth.size());
    for (std::size_t i = 0; i < walk.truth.size(); ++i) {
      EXPECT_EQ(sequence.points[i].target, walk.truth[i].target) << i;
      EXPECT_EQ(sequence.points[i].run, walk.truth[i].run) << i;
      EXPECT_EQ(sequence.points[i].point.direction, walk.truth[i].direction) << i;
    }
    expect_equal_sequences(sequence, recognise_sequence(walk.stops, {}));
  }
}

// A stop without target, an interrupted stop, an overshot stop, and stops whose approach is
// unknown.
TEST(SequenceTail, OddStopsEqualThoseOfTheWholeLog) {
  SequenceOptions given;
  for (int i = 0; i < 11; ++i) given.targets_m.push_back(i * 5e-3);
  Walk walk;
  walk.standard(11, 5e-3, 12);
  auto& stops = walk.stops;
  stops[150].position_m += 1e-3;  // a stop without target
  Point part = stops[170];
  part.begin_ns += 400'000'000, part.end_ns += 400'000'000, part.samples = 500;
  part.travel_min_m = part.travel_max_m = part.position_m;
  // The longer part of the same stop, which was interrupted.
  stops.insert(stops.begin() + 171, part);
  stops[180].travel_max_m = stops[180].position_m + 100e-6;
  stops[180].travel_min_m = stops[180].position_m - 5e-3;
  stops[180].direction = -1;                       // returns from 0.1 mm beyond the target
  for (const std::size_t unseen : {200u, 215u}) {  // unknown approach: forward and reverse
    stops[unseen].direction = 0;
    stops[unseen].travel_min_m = stops[unseen].travel_max_m = kNaN;
  }
  for (const std::size_t whole : {130u, 150u, 171u, 181u, 200u, 201u, 215u, 216u})
    expect_equal_sequences(grown(stops, whole, given), recognise_sequence(stops, given));
}

// Five targets 5 mm apart. The first `whole` stops are recognised together; the other stops are
// appended.
Sequence appended(const std::vector<Point>& stops, std::size_t whole) {
  SequenceOptions given;
  for (int i = 0; i < 5; ++i) given.targets_m.push_back(i * 5e-3);
  return grown(stops, whole, given);
}

// During a gap the axis left its last target and returned. The stop has the approach of the stop
// before.
TEST(SequenceTail, StopAtTheLastTargetKeepsItsApproach) {
  Walk walk;
  for (int i = 0; i < 5; ++i) walk.stop(i * 5e-3, i + 1, 1);
  Point again = walk.stops.back();
  again.begin_ns += 500'000'000, again.end_ns += 500'000'000;
  again.direction = 0, again.travel_max_m += 1e-3;
  walk.stops.push_back(again);
  walk.stop(15e-3, 4, 1);
  for (const std::size_t whole : {5u, 6u}) {
    const Sequence sequence = appended(walk.stops, whole);
    ASSERT_EQ(sequence.points.size(), 7u);
    EXPECT_EQ(sequence.points[5].point.direction, 1) << whole;
    EXPECT_TRUE(has_flag(sequence.points[5].point, Flag::approach_assumed)) << whole;
    EXPECT_EQ(sequence.points[6].point.direction, -1) << whole;
  }
}

// After target 4 the axis is at target 5 again. The approach of this stop follows from the next
// motion and not from an earlier stop.
TEST(SequenceTail, StopElsewhereWaitsForTheNextMotion) {
  Walk walk;
  for (int i = 0; i < 5; ++i) walk.stop(i * 5e-3, i + 1, 1);
  walk.stop(15e-3, 4, 1);
  walk.stop(20e-3, 5, 2);
  walk.stops.back().direction = 0;
  walk.stops.back().travel_min_m = walk.stops.back().travel_max_m = kNaN;
  const Sequence last = appended(walk.stops, 6);
  EXPECT_EQ(last.points.back().point.direction, 1);  // until the next motion is known
  EXPECT_TRUE(has_flag(last.points.back().point, Flag::approach_assumed));
  walk.stop(10e-3, 3, 1);
  for (const std::size_t whole : {6u, 7u}) {
    const Sequence sequence = appended(walk.stops, whole);
    ASSERT_EQ(sequence.points.size(), 8u);
    EXPECT_EQ(sequence.points[6].point.direction, -1) << whole;
  }
}

// Each stop is at a new position beyond the other targets, so its target is appended at the end.
TEST(SequenceTail, AppendsNewTargetsAtTheEnd) {
  Walk walk;
  for (int i = 0; i < 600; ++i) walk.stop(i * 1e-3, i + 1, 1);
  const Sequence sequence = grown(walk.stops, 256, {});
  ASSERT_EQ(sequence.points.size(), 600u);
  EXPECT_EQ(sequence.targets, 600);
  for (std::size_t i = 0; i < 600; ++i) {
    EXPECT_EQ(sequence.points[i].target, static_cast<int>(i) + 1);
    EXPECT_EQ(sequence.points[i].run, 1);
  }
}

// One new position is between the last two targets, one is before the first target. The numbers of
// the targets at larger positions increase by 1.
TEST(SequenceTail, NewTargetRenumbersTheTargetsBeyond) {
  Walk walk;
  for (int i = 0; i < 5; ++i) walk.stop(i * 5e-3, i + 1, 1);
  walk.stop(18e-3, 0, 1);
  walk.stop(-5e-3, 0, 1);
  const Sequence sequence = grown(walk.stops, 5, {});
  EXPECT_EQ(sequence.targets, 7);
  EXPECT_EQ(sequence.targets_m, (std::vector<double>{-5e-3, 0, 5e-3, 10e-3, 15e-3, 18e-3, 20e-3}));
  ASSERT_EQ(sequence.points.size(), 7u);
  const int expected[] = {2, 3, 4, 5, 7, 6, 1};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(sequence.points[i].target, expected[i]) << i;
    EXPECT_EQ(sequence.points[i].target_m, walk.stops[i].position_m) << i;
  }
}

}  // namespace
}  // namespace mdof::algo
