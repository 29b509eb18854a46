// Tests which positions are not targets, depending on their visits and distances, on both sides of
// each limit. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "algo/points/flags.h"
#include "algo/sequence/sequence_stops.h"

namespace mdof::algo {
namespace {

// A position and the numbers of its visits from below and from above.
struct Visited {
  double position_mm;
  int forward, reverse;
};

struct Told {
  std::vector<double> kept_mm;
  std::vector<std::string> reasons;  // reason for each stop that is left out
};

// Simulates a log. The axis visits all positions, then again those with more visits, so the log
// ends at one of these.
Told left_out_stops(const std::vector<Visited>& places, bool parked_first = false) {
  std::vector<double> targets_m;
  for (const Visited& place : places) targets_m.push_back(1e-3 * place.position_mm);
  std::vector<MeasuredPoint> points;
  for (int i = 0; i < 20; ++i) {
    for (std::size_t t = 0; t < places.size(); ++t) {
      if (i >= places[t].forward + places[t].reverse) continue;
      MeasuredPoint p;
      p.target = static_cast<int>(t) + 1;
      p.point.position_m = targets_m[t];
      p.point.direction = i < places[t].forward ? 1 : -1;
      points.push_back(p);
    }
  }
  if (parked_first) add_flag(points.front().point, Flag::approach_assumed);
  Told reported;
  for (const StopLeftOut& stop : leave_out_odd_stops(points, targets_m).left_out)
    reported.reasons.push_back(stop.reason);
  for (const double x : targets_m) reported.kept_mm.push_back(1e3 * x);
  for (const MeasuredPoint& p : points)
    EXPECT_EQ(p.point.position_m, targets_m[static_cast<std::size_t>(p.target) - 1]);
  return reported;
}

// The targets are at 0, 10 ... 60 mm; one more position is added.
Told stops_with_place(const Visited& odd, int forward, int reverse) {
  std::vector<Visited> places;
  for (int i = 0; i < 7; ++i) places.push_back({10.0 * i, forward, reverse});
  const auto above = [](const Visited& a, const Visited& b) {
    return a.position_mm < b.position_mm;
  };
  places.insert(std::upper_bound(places.begin(), places.end(), odd, above), odd);
  return left_out_stops(places);
}

bool is_target(const Visited& place, int forward, int reverse) {
  const Told reported = stops_with_place(place, forward, reverse);
  EXPECT_EQ(reported.kept_mm.size() + (reported.reasons.empty() ? 0 : 1), 8u);
  return reported.reasons.empty();
}

TEST(OddStops, TargetNeedsSixTenthsOfTheVisits) {
  EXPECT_TRUE(is_target({3, 3, 3}, 5, 5));   // 6 of 10 visits: a target at any distance
  EXPECT_FALSE(is_target({3, 3, 2}, 5, 5));  // 3 mm from the next target
  EXPECT_FALSE(is_target({3, 6, 0}, 5, 5));  // visited from one side only
  EXPECT_TRUE(is_target({3, 3, 0}, 5, 0));
  EXPECT_FALSE(is_target({3, 2, 0}, 5, 0));
  EXPECT_TRUE(is_target({3, 0, 3}, 0, 5));
  EXPECT_FALSE(is_target({3, 3, 0}, 0, 5));  // visited from the other side than the targets
}

// A position between two targets is a target if its distances from both are at least 0.6 of the
// interval.
TEST(OddStops, PlaceBetweenDistantTargetsIsATarget) {
  const auto with_gap = [](double gap_mm, double at_mm) {
    std::vector<Visited> places;
    for (int i = 0; i < 4; ++i) places.push_back({10.0 * i, 3, 3});
    places.push_back({30 + at_mm, 1, 1});
    for (int i = 0; i < 4; ++i) places.push_back({30 + gap_mm + 10.0 * i, 3, 3});
    return left_out_stops(places).reasons;
  };
  EXPECT_TRUE(with_gap(20, 10).empty());
  EXPECT_TRUE(with_gap(20, 6.1).empty());
  EXPECT_TRUE(with_gap(20, 13.9).empty());
  EXPECT_EQ(with_gap(20, 5.9).size(), 2u);
  EXPECT_EQ(with_gap(20, 14.1).size(), 2u);
}

// Beyond the end targets, a position is a target if its distance is up to 1.6 of the interval.
TEST(OddStops, PlaceBeyondTheEndMustBeNear) {
  for (const bool below : {false, true}) {
    const auto at = [&](double off_mm) { return below ? -off_mm : 60 + off_mm; };
    EXPECT_FALSE(is_target({at(5.9), 1, 1}, 3, 3));
    EXPECT_TRUE(is_target({at(6.1), 1, 1}, 3, 3));
    EXPECT_TRUE(is_target({at(15.9), 1, 1}, 3, 3));
    EXPECT_FALSE(is_target({at(16.1), 1, 1}, 3, 3));
  }
}

// A position beyond the end with one visit is no target if the targets have three visits. With two
// visits it may be a target.
TEST(OddStops, OneVisitBeyondTheEndIsTooFewBesideThree) {
  for (const double at_mm : {-10.0, 70.0}) {
    EXPECT_TRUE(is_target({at_mm, 1, 0}, 2, 0));
    EXPECT_FALSE(is_target({at_mm, 1, 0}, 3, 0));
    EXPECT_FALSE(is_target({at_mm, 1, 0}, 3, 3));
  }
}

// Positions with more visits are evaluated first. If 72 mm is a target, 67 mm is no target.
TEST(OddStops, PlacesWithMoreVisitsAreEvaluatedFirst) {
  const auto beyond = [](int near, int far) {
    std::vector<Visited> places;
    for (int i = 0; i < 7; ++i) places.push_back({10.0 * i, 3, 3});
    places.push_back({67, near, 0});
    places.push_back({72, far, 0});
    return left_out_stops(places).kept_mm.back();
  };
  EXPECT_NEAR(beyond(2, 3), 72, 1e-9);
  EXPECT_NEAR(beyond(3, 2), 67, 1e-9);
  EXPECT_NEAR(beyond(2, 2), 67, 1e-9);  // with equal visits the nearer position is evaluated first
}

// Several positions with few visits continue the row of targets, one after the other.
TEST(OddStops, PositionsWithFewVisitsContinueTheRow) {
  std::vector<Visited> places;
  for (int i = 0; i < 10; ++i) places.push_back({10.0 * i, i < 7 ? 3 : 1, i < 7 ? 3 : 1});
  EXPECT_TRUE(left_out_stops(places).reasons.empty());
}

TEST(OddStops, ReasonDescribesThePlace) {
  EXPECT_EQ(stops_with_place({3, 2, 0}, 3, 3).reasons,
            std::vector<std::string>(2, "stop_between_targets"));
  EXPECT_EQ(stops_with_place({62, 1, 1}, 3, 3).reasons,
            std::vector<std::string>(2, "stop_beyond_targets"));
  EXPECT_EQ(stops_with_place({3, 2, 2}, 4, 4).reasons,
            std::vector<std::string>(4, "stop_between_targets"));
  EXPECT_EQ(stops_with_place({-2, 1, 0}, 3, 3).reasons,
            std::vector<std::string>{"stop_before_first_target"});
  EXPECT_EQ(stops_with_place({62, 1, 0}, 3, 3).reasons,
            std::vector<std::string>{"stop_beyond_targets"});
}

// Each position has one visit. A parked start beside the targets is recognised if there are at
// least four positions.
TEST(OddStops, LeavesOutAParkedStartOfASinglePass) {
  const auto kept = [](double parked_mm, int targets) {
    std::vector<Visited> places = {{parked_mm, 1, 0}};
    for (int i = 1; i <= targets; ++i) places.push_back({10.0 * i, 1, 0});
    return left_out_stops(places, true).reasons.empty();
  };
  EXPECT_TRUE(kept(0, 4));
  EXPECT_FALSE(kept(4.1, 4));  // 5.9 mm from the next target
  EXPECT_TRUE(kept(3.9, 4));
  EXPECT_TRUE(kept(-5.9, 4));
  EXPECT_FALSE(kept(-6.1, 4));
  EXPECT_FALSE(kept(-6.1, 3));
  EXPECT_TRUE(kept(-6.1, 2));  // three positions are too few
}

// ---- typical values of the other positions ----

// Kept positions of a log in which the order of the visits has no effect.
std::vector<double> kept_positions_mm(const std::vector<Visited>& places) {
  return left_out_stops(places).kept_mm;
}

void expect_kept(const std::vector<Visited>& places, const std::vector<double>& expected_mm) {
  const std::vector<double> kept_mm = kept_positions_mm(places);
  ASSERT_EQ(kept_mm.size(), expected_mm.size());
  for (std::size_t i = 0; i < kept_mm.size(); ++i) EXPECT_NEAR(kept_mm[i], expected_mm[i], 1e-9);
}

// The typical number of visits is the number that three quarters of the stops do not exceed. In the
// first case, 12 of 16 stops are at positions with at most two visits, so 3 mm is no target. In the
// second case, fewer than three quarters of the stops are at positions with one visit, so two
// visits are typical. Only one position has two visits.
TEST(OddStopsTypical, CoversThreeQuartersOfTheStops) {
  expect_kept({{0, 2, 0},
               {3, 1, 0},
               {10, 2, 0},
               {20, 2, 0},
               {30, 1, 0},
               {40, 2, 0},
               {50, 2, 0},
               {60, 4, 0}},
              {0, 10, 20, 30, 40, 50, 60});
  EXPECT_TRUE(left_out_stops(
                  {{4.1, 1, 0}, {10, 1, 0}, {20, 1, 0}, {30, 2, 0}, {40, 1, 0}, {50, 1, 0}}, true)
                  .reasons.empty());
}

// Targets are visited from both sides if the majority of positions is. Only positions with at least
// three quarters of the typical visits count for this majority.
TEST(OddStopsTypical, MajorityDecidesBothSidesOrOne) {
  expect_kept({{0, 3, 3}, {3, 6, 0}, {10, 3, 3}, {13, 6, 0}}, {0, 10});
  // Two positions against three. The position with one visit from each side does not count.
  expect_kept({{0, 3, 3}, {3, 6, 0}, {10, 3, 3}, {13, 6, 0}, {23, 6, 0}, {33, 1, 1}},
              {3, 13, 23, 33});
  // A position with three visits counts if four visits are typical.
  expect_kept({{0, 2, 2}, {3, 4, 0}, {10, 2, 2}, {13, 4, 0}, {23, 3, 0}}, {3, 13, 23});
}

// 11 visits are from below, 12 from above.
TEST(OddStopsTypical, UsesTheSideWithMoreVisits) {
  expect_kept({{0, 0, 4}, {3, 4, 0}, {10, 0, 4}, {13, 4, 0}, {20, 0, 4}, {23, 3, 0}}, {0, 10, 20});
}

TEST(OddStopsTypical, FromAboveOnlyIsNotFromBothSides) {
  EXPECT_FALSE(is_target({3, 0, 6}, 5, 5));
}

// The middle intervals are 5 and 20 mm. The larger is used, so 37 mm is too near to a target.
TEST(OddStopsTypical, UsesTheLargerMiddleInterval) {
  expect_kept({{0, 3, 3}, {5, 3, 3}, {10, 3, 3}, {30, 3, 3}, {37, 1, 1}, {50, 3, 3}},
              {0, 5, 10, 30, 50});
}

// A position with one visit is 6.5 mm beyond the last target with three visits, so it is no target.
// A position 8.5 mm further may be the first of a new row of targets.
TEST(OddStopsTypical, OneVisitNearATargetIsNoTarget) {
  for (const bool below : {false, true}) {
    std::vector<Visited> places;
    for (int i = 0; i < 7; ++i) places.push_back({10.0 * i, 3, 3});
    const double near_mm = below ? -6.5 : 66.5, far_mm = below ? -15 : 75;
    places.insert(below ? places.begin() : places.end(), {near_mm, 1, 0});
    places.insert(below ? places.begin() : places.end(), {far_mm, 1, 0});
    const std::vector<double> kept_mm = kept_positions_mm(places);
    ASSERT_EQ(kept_mm.size(), 8u);
    EXPECT_NEAR(below ? kept_mm.front() : kept_mm.back(), far_mm, 1e-9);
  }
}

// ---- logs with a given order of stops ----

struct Stop {
  double position_mm;
  int direction;
};

std::vector<std::string> left_out_reasons(const std::vector<Stop>& stops,
                                          bool parked_first = false) {
  std::vector<double> targets_m;
  for (const Stop& stop : stops) targets_m.push_back(1e-3 * stop.position_mm);
  std::sort(targets_m.begin(), targets_m.end());
  targets_m.erase(std::unique(targets_m.begin(), targets_m.end()), targets_m.end());
  std::vector<MeasuredPoint> points;
  for (const Stop& stop : stops) {
    MeasuredPoint p;
    p.point.position_m = 1e-3 * stop.position_mm;
    p.point.direction = stop.direction;
    p.target = static_cast<int>(nearest_target(targets_m, p.point.position_m)) + 1;
    points.push_back(p);
  }
  if (parked_first) add_flag(points.front().point, Flag::approach_assumed);
  std::vector<std::string> reasons;
  for (const StopLeftOut& stop : leave_out_odd_stops(points, targets_m).left_out)
    reasons.push_back(stop.reason);
  return reasons;
}

TEST(OddStopsOfALog, LastStopHasTheReasonEndOfLog) {
  std::vector<Stop> stops;
  for (int pass = 0; pass < 5; ++pass)
    for (int i = 0; i < 7; ++i) stops.push_back({10.0 * i, 1});
  stops.push_back({63, 1});
  EXPECT_EQ(left_out_reasons(stops), std::vector<std::string>{"stop_at_end_of_log"});
  stops.push_back({60, 1});  // 63 mm is no longer the last stop
  EXPECT_EQ(left_out_reasons(stops), std::vector<std::string>{"stop_beyond_targets"});
  stops.push_back({63, 1});  // 63 mm is the last stop again
  EXPECT_EQ(left_out_reasons(stops), std::vector<std::string>(2, "stop_beyond_targets"));
}

// The axis is parked above the targets and then makes a single pass downwards.
TEST(OddStopsOfALog, LeavesOutAParkedStartAboveTheTargets) {
  const auto kept = [](double parked_mm, bool parked) {
    std::vector<Stop> stops = {{parked_mm, -1}};
    for (int i = 4; i >= 1; --i) stops.push_back({10.0 * i, -1});
    return left_out_reasons(stops, parked).empty();
  };
  EXPECT_FALSE(kept(45.9, true));
  EXPECT_TRUE(kept(46.1, true));
  EXPECT_TRUE(kept(55.9, true));
  EXPECT_FALSE(kept(56.1, true));
  EXPECT_TRUE(kept(56.1, false));
}

// Each position has one visit, so neither side has more visits.
TEST(OddStopsOfALog, KeepsAllPlacesWithOneVisitEach) {
  EXPECT_TRUE(left_out_reasons({{0, 1}, {10, 1}, {30, 1}, {20, -1}}).empty());
}

// The log begins at the first target, which is then visited `forward` times from below and
// `reverse` times from above; the others are visited twice from each side.
int assumed_target_of(int forward, int reverse) {
  std::vector<double> targets_m;
  std::vector<MeasuredPoint> points;
  const auto stop_at = [&](int target, int direction) {
    MeasuredPoint p;
    p.target = target;
    p.point.position_m = targets_m[static_cast<std::size_t>(target) - 1];
    p.point.direction = direction;
    points.push_back(p);
  };
  for (int i = 0; i < 6; ++i) targets_m.push_back(10e-3 * i);
  stop_at(1, 1);
  add_flag(points.front().point, Flag::approach_assumed);
  for (int pass = 0; pass < 2; ++pass) {
    if (pass < forward) stop_at(1, 1);
    for (int t = 2; t <= 6; ++t) stop_at(t, 1);
    for (int t = 6; t >= 2; --t) stop_at(t, -1);
    if (pass < reverse) stop_at(1, -1);
  }
  return leave_out_odd_stops(points, targets_m).assumed_target;
}

TEST(OddStopsOfALog, FirstTargetIsAssumedIfItHasOneApproach) {
  EXPECT_EQ(assumed_target_of(2, 2), 0);
  EXPECT_EQ(assumed_target_of(1, 2), 0);
  EXPECT_EQ(assumed_target_of(0, 2), 1);
}

}  // namespace
}  // namespace mdof::algo
