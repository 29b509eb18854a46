#include "daemon/measure/completeness.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

const std::vector<double> kTargets_m = {0, 0.002, 0.0041};

MeasuredPoint point(int target, int direction, int run = 1, const std::string& reason = "") {
  MeasuredPoint p;
  p.target = target;
  p.run = run;
  p.point.direction = direction;
  p.errors.valid = reason.empty();
  p.errors.reason = reason;
  return p;
}

// There and back, so often.
std::vector<MeasuredPoint> passes(int repeats) {
  std::vector<MeasuredPoint> points;
  for (int run = 1; run <= repeats; ++run) {
    for (const int target : {1, 2, 3}) points.push_back(point(target, 1, run));
    for (const int target : {3, 2, 1}) points.push_back(point(target, -1, run));
  }
  return points;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Completeness, AllTargetsOfAllRepeatsFromBothSidesAreComplete) {
  EXPECT_TRUE(all_measured(kTargets_m, 2, passes(2)));
  EXPECT_TRUE(what_is_missing(kTargets_m, 2, passes(2)).empty());
  EXPECT_TRUE(what_is_missing(kTargets_m, 2, passes(3)).empty());
}

TEST(Completeness, WhatIsMissingIsSaidByTargetAndApproach) {
  auto points = passes(2);
  points.resize(9);  // the way back of the second repeat did not come
  EXPECT_FALSE(all_measured(kTargets_m, 2, points));
  const auto missing = what_is_missing(kTargets_m, 2, points);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0],
            "3 of 12 points asked for are missing: target 1 at 0.000 mm: 1 reverse; target 2 at "
            "2.000 mm: 1 reverse; target 3 at 4.100 mm: 1 reverse");
  points.erase(points.begin());
  EXPECT_TRUE(contains(what_is_missing(kTargets_m, 2, points)[0],
                       "target 1 at 0.000 mm: 1 forward, 1 reverse"));
}

TEST(Completeness, AnUnsolvedPointIsMissingAndItsReasonIsSaid) {
  auto points = passes(1);
  points[4] = point(2, -1, 1, "probe \"B\" is lost");
  EXPECT_FALSE(all_measured(kTargets_m, 1, points));
  const auto missing = what_is_missing(kTargets_m, 1, points);
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_TRUE(contains(missing[0], "1 of 6 points")) << missing[0];
  EXPECT_EQ(missing[1],
            "1 of 6 points could not be solved, most of them because: probe \"B\" is lost");
  points.push_back(point(2, -1, 2));  // measured once more
  EXPECT_TRUE(all_measured(kTargets_m, 1, points));
  EXPECT_TRUE(what_is_missing(kTargets_m, 1, points).empty());
}

TEST(Completeness, MostPointsUnsolvedIsNotComplete) {
  std::vector<MeasuredPoint> points(269, point(1, 1, 1, "five probes are needed"));
  points.insert(points.end(), 6, point(1, 1));
  const auto missing = what_is_missing({}, 0, points);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0],
            "269 of 275 points could not be solved, most of them because: five probes are needed");
  EXPECT_TRUE(what_is_missing({}, 0, {points.begin() + 263, points.end()}).empty());
}

TEST(Completeness, AFreeRunIsAsItWasAskedFor) {
  EXPECT_TRUE(what_is_missing({}, 0, passes(1)).empty());
  EXPECT_FALSE(all_measured({}, 0, passes(1)));  // until it is stopped
  EXPECT_FALSE(all_measured(kTargets_m, 0, passes(1)));
}

TEST(Completeness, WithoutRepeatsATargetIsMeasuredOnceAtLeast) {
  EXPECT_TRUE(what_is_missing(kTargets_m, 0, {point(1, 1), point(2, 1), point(3, -1)}).empty());
  const auto missing = what_is_missing(kTargets_m, 0, {point(1, 1), point(2, 1)});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0], "1 of 3 targets were never measured: target 3 at 4.100 mm");
}

TEST(Completeness, ManyMissingTargetsAreCountedNotListed) {
  const std::vector<double> many(40, 0.0);
  const auto missing = what_is_missing(many, 5, {point(1, 1)});
  EXPECT_TRUE(contains(missing[0], "399 of 400")) << missing[0];
  EXPECT_TRUE(contains(missing[0], "; and 34 more targets")) << missing[0];
  EXPECT_LT(missing[0].size(), 400u);
}

// A point of no target, as in a run without them, is of none.
TEST(Completeness, AStrayTargetNumberIsLeftOut) {
  EXPECT_FALSE(all_measured(kTargets_m, 1, {point(0, 1), point(99, 1), point(-3, 1)}));
}

}  // namespace
}  // namespace mdof::daemon
