// Tests each part of recognise_sequence() separately. The stops are defined by hand, on both sides
// of the limits. Mutation tests (tests/mutate) found these cases.
#include "algo/sequence/sequence_stops.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "schema/sample.h"
#include "tests/algo/stepping_log.h"

namespace mdof::algo {
namespace {

using StopPlaces = std::vector<double>;

std::vector<Point> stops_at(const StopPlaces& positions_m) {
  std::vector<Point> points;
  for (const double x : positions_m) {
    Point p;
    p.position_m = x;
    points.push_back(p);
  }
  return points;
}

// A stop at a target, with the range of the motion before it.
MeasuredPoint stop_of(int target, double position_m, int direction, double travel_min_m,
                      double travel_max_m, std::size_t samples = 100) {
  MeasuredPoint p;
  p.target = target;
  p.point.position_m = position_m;
  p.point.direction = direction;
  p.point.travel_min_m = travel_min_m;
  p.point.travel_max_m = travel_max_m;
  p.point.samples = samples;
  return p;
}

TEST(TargetsOfStops, AreEmptyWithoutStops) {
  EXPECT_EQ(stop_targets({}), StopPlaces{});
  EXPECT_EQ(stop_targets(stops_at({3e-3})), StopPlaces{3e-3});
}

// The stops of a target may scatter by at most 50 um.
TEST(TargetsOfStops, ScatterByAtMostFiftyMicrometres) {
  EXPECT_EQ(stop_targets(stops_at({0, 50e-6, 10e-3})), (StopPlaces{0, 10e-3}));
  EXPECT_EQ(stop_targets(stops_at({0, 51e-6, 10e-3})), (StopPlaces{0, 51e-6, 10e-3}));
}

// The distance to the next target is at least ten times the scatter of the stops. The test uses
// multiples of 2^-18 m, which have no rounding errors.
TEST(TargetsOfStops, AreTenTimesAsFarApartAsTheirStops) {
  const double part_m = 0x1p-18;  // 3.8 um
  EXPECT_EQ(stop_targets(stops_at({0, part_m, 11 * part_m})), (StopPlaces{0, 11 * part_m}));
  EXPECT_EQ(stop_targets(stops_at({0, part_m, 10.9 * part_m})).size(), 3u);
}

// Ratios of successive gaps: the first gap is 20 times the smallest scatter (2 um), the second gap
// is 11 times the first. The first ratio is larger and is used.
TEST(TargetsOfStops, FirstGapDecidesIfItsRatioIsLarger) {
  EXPECT_EQ(stop_targets(stops_at({0, 1e-7, 40.1e-6, 480.1e-6})),
            (StopPlaces{0, 40.1e-6, 480.1e-6}));
}

// The larger ratio is used: steps of 4, 40 and 5956 um have the ratios 10 and 149. A step of 60 um
// is too large for scatter, so the ratio after it is not used.
TEST(TargetsOfStops, LargestGapRatioDecides) {
  EXPECT_EQ(stop_targets(stops_at({0, 4e-6, 64e-6, 6e-3})).size(), 3u);
  EXPECT_EQ(stop_targets(stops_at({0, 4e-6, 44e-6, 6e-3})), (StopPlaces{0, 6e-3}));
}

TEST(TargetsOfStops, StopsWithinTwoMicrometresAreOne) {
  EXPECT_EQ(stop_targets(stops_at({2e-6, 0, 1e-6, 3e-6})), StopPlaces{2e-6});
  EXPECT_EQ(stop_targets(stops_at({0, 1e-9, 0.5e-6, 2e-6})), StopPlaces{0});
  EXPECT_EQ(stop_targets(stops_at({0, 2.1e-6})).size(), 2u);
}

// The position of a target is its first stop, not the lowest and not the last.
TEST(TargetsOfStops, AreAtTheFirstStop) {
  EXPECT_EQ(stop_targets(stops_at({5.001e-3, 1e-6, 5e-3, 0, 5.002e-3})),
            (StopPlaces{1e-6, 5.001e-3}));
}

TEST(NearestTarget, IsTheNearerNeighbour) {
  const StopPlaces targets_m = {0, 1, 3};
  EXPECT_EQ(nearest_target(targets_m, -5), 0u);
  EXPECT_EQ(nearest_target(targets_m, 0.4), 0u);
  EXPECT_EQ(nearest_target(targets_m, 0.5), 0u);  // two targets are equally far: the lower one
  EXPECT_EQ(nearest_target(targets_m, 0.6), 1u);
  EXPECT_EQ(nearest_target(targets_m, 1), 1u);
  EXPECT_EQ(nearest_target(targets_m, 1.9), 1u);
  EXPECT_EQ(nearest_target(targets_m, 2.1), 2u);
  EXPECT_EQ(nearest_target(targets_m, 7), 2u);
}

// The axis comes from the distance `from_m`, moves `beyond_m` beyond 0, and returns to 0.
bool is_overshot(int direction, double beyond_m, double from_m) {
  Point p;
  p.direction = direction;  // direction of the correction, the last motion
  p.travel_min_m = direction < 0 ? -from_m : -beyond_m;
  p.travel_max_m = direction < 0 ? beyond_m : from_m;
  const bool overshot = correct_overshot(p);
  EXPECT_EQ(p.direction, overshot ? -direction : direction);
  EXPECT_EQ(has_flag(p, Flag::overshot), overshot);
  return overshot;
}

TEST(Overshot, IsFrom40To250Micrometres) {
  for (const int direction : {1, -1}) {
    EXPECT_FALSE(is_overshot(direction, 40e-6, 5e-3));
    EXPECT_TRUE(is_overshot(direction, 41e-6, 5e-3));
    EXPECT_TRUE(is_overshot(direction, 0.25e-3, 5e-3));
    EXPECT_FALSE(is_overshot(direction, 0.251e-3, 5e-3));
    EXPECT_TRUE(is_overshot(direction, 0.1e-3, 0.21e-3));
    EXPECT_FALSE(is_overshot(direction, 0.1e-3, 0.2e-3));  // `from_m` must exceed twice `beyond_m`
    EXPECT_FALSE(is_overshot(direction, kNaN, kNaN));
  }
  EXPECT_FALSE(is_overshot(0, 0.1e-3, 5e-3));
}

TEST(Overshot, AreCounted) {
  std::vector<Point> points(4);
  for (Point& p : points) p.direction = -1, p.travel_min_m = -5e-3, p.travel_max_m = 0;
  EXPECT_EQ(correct_overshot(points), 0);
  points[1].travel_max_m = points[3].travel_max_m = 0.1e-3;
  EXPECT_EQ(correct_overshot(points), 2);
  EXPECT_EQ(points[0].direction, -1);
  EXPECT_EQ(points[3].direction, 1);
}

std::vector<int> assumed(std::vector<MeasuredPoint> points) {
  assume_approaches(points);
  std::vector<int> directions;
  for (const MeasuredPoint& p : points) directions.push_back(p.point.direction);
  return directions;
}

TEST(AssumedApproach, IsThatOfTheNextMotion) {
  const auto at = [](int target, int direction) {
    return stop_of(target, 1e-3 * target, direction, kNaN, kNaN);
  };
  EXPECT_EQ(assumed({at(3, 0), at(4, 1)}), (std::vector{1, 1}));
  EXPECT_EQ(assumed({at(3, 0), at(2, -1)}), (std::vector{-1, -1}));
  EXPECT_EQ(assumed({at(3, 0), at(3, -1)}), (std::vector{1, -1}));
  EXPECT_EQ(assumed({at(3, 0)}), std::vector{1});
  // The axis did not move.
  EXPECT_EQ(assumed({at(3, -1), at(3, 0), at(5, 1)}), (std::vector{-1, -1, 1}));
  EXPECT_EQ(assumed({at(2, 1), at(3, 0), at(1, -1)}), (std::vector{1, -1, -1}));
  std::vector<MeasuredPoint> points = {at(3, 0), at(4, 1)};
  assume_approaches(points);
  EXPECT_TRUE(has_flag(points[0].point, Flag::approach_assumed));
  EXPECT_FALSE(has_flag(points[1].point, Flag::approach_assumed));
}

// The longer part of an interrupted stop is used, or the first if both are equally long. Its
// approach is the approach of the first part.
TEST(Interrupted, KeepsTheLongerPart) {
  for (const std::size_t samples : {99u, 100u, 101u}) {
    std::vector<MeasuredPoint> points = {stop_of(2, 5e-3, 1, 0, 5e-3),
                                         stop_of(2, 5.001e-3, 1, 5e-3, 5.001e-3, samples)};
    merge_interrupted(points);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].point.position_m, samples > 100 ? 5.001e-3 : 5e-3) << samples;
    EXPECT_EQ(points[0].point.travel_min_m, 0);
    EXPECT_EQ(points[0].point.travel_max_m, 5e-3);
    EXPECT_TRUE(has_flag(points[0].point, Flag::interrupted));
  }
}

TEST(Interrupted, KeepsStopsThatTheAxisLeft) {
  const auto left = [](const MeasuredPoint& second) {
    std::vector<MeasuredPoint> points = {stop_of(2, 0, 1, -5e-3, 0), second};
    merge_interrupted(points);
    return points.size();
  };
  EXPECT_EQ(left(stop_of(2, 0, 1, -50e-6, 50e-6)), 1u);
  EXPECT_EQ(left(stop_of(2, 0, 1, -51e-6, 0)), 2u);
  EXPECT_EQ(left(stop_of(2, 0, 1, 0, 51e-6)), 2u);
  EXPECT_EQ(left(stop_of(2, 0, -1, 0, 0)), 2u);
  EXPECT_EQ(left(stop_of(3, 0, 1, 0, 0)), 2u);
}

TEST(ParkedStart, IsLeftOutIfTheAxisReturns) {
  const auto left_out = [](bool assumed, const MeasuredPoint& next) {
    std::vector<MeasuredPoint> points = {stop_of(1, 2e-6, 1, kNaN, kNaN), next};
    points[0].point.begin_ns = 7;
    if (assumed) points[0].point.flags.push_back({Flag::approach_assumed});
    const auto found = leave_out_parked_start(points);
    EXPECT_EQ(points.size(), 2 - found.size());
    if (!found.empty()) {
      EXPECT_EQ(found[0].position_m, 2e-6);
      EXPECT_EQ(found[0].begin_ns, 7);
      EXPECT_EQ(points[0].point.position_m, next.point.position_m);
    }
    return found.size();
  };
  EXPECT_EQ(left_out(true, stop_of(1, 0, 1, -1e-3, 0)), 1u);
  EXPECT_EQ(left_out(false, stop_of(1, 0, 1, -1e-3, 0)), 0u);
  EXPECT_EQ(left_out(true, stop_of(1, 0, -1, -1e-3, 0)), 0u);
  EXPECT_EQ(left_out(true, stop_of(2, 0, 1, -1e-3, 0)), 0u);
  EXPECT_EQ(left_out(true, stop_of(1, 0, 1, -10e-6, 0)), 0u);  // the axis did not move
  std::vector<MeasuredPoint> none, one = {stop_of(1, 0, 1, -1e-3, 0)};
  EXPECT_TRUE(leave_out_parked_start(none).empty());
  EXPECT_TRUE(leave_out_parked_start(one).empty());
}

}  // namespace
}  // namespace mdof::algo
