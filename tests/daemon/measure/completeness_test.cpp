#include "daemon/measure/completeness.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

using test::shown;

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

// The points of `repeats` passes; each pass goes forward and back.
std::vector<MeasuredPoint> passes(int repeats) {
  std::vector<MeasuredPoint> points;
  for (int run = 1; run <= repeats; ++run) {
    for (const int target : {1, 2, 3}) points.push_back(point(target, 1, run));
    for (const int target : {3, 2, 1}) points.push_back(point(target, -1, run));
  }
  return points;
}

TEST(Completeness, AllTargetsRepeatsAndApproachesAreComplete) {
  EXPECT_TRUE(all_measured(kTargets_m, 2, passes(2)));
  EXPECT_TRUE(missing_notices(kTargets_m, 2, passes(2)).empty());
  EXPECT_TRUE(missing_notices(kTargets_m, 2, passes(3)).empty());
}

TEST(Completeness, ReportsMissingPointsByTargetAndApproach) {
  auto points = passes(2);
  points.resize(9);  // removes the points on the way back of the second repeat
  EXPECT_FALSE(all_measured(kTargets_m, 2, points));
  const auto missing = missing_notices(kTargets_m, 2, points);
  EXPECT_EQ(shown(missing),
            "points_missing missing=3 of=12 targets=target 1 at 0.000 mm: 1 reverse; target 2 at "
            "2.000 mm: 1 reverse; target 3 at 4.100 mm: 1 reverse\n");
  points.erase(points.begin());
  EXPECT_EQ(shown(missing_notices(kTargets_m, 2, points))
                .find("points_missing missing=4 of=12 targets=target 1 at 0.000 mm: 1 forward, 1 "
                      "reverse;"),
            0u);
}

TEST(Completeness, ReportsAnUnsolvedPointAsMissingWithItsReason) {
  auto points = passes(1);
  points[4] = point(2, -1, 1, "probe \"B\" is lost");
  EXPECT_FALSE(all_measured(kTargets_m, 1, points));
  const auto missing = missing_notices(kTargets_m, 1, points);
  EXPECT_EQ(shown(missing),
            "points_missing missing=1 of=6 targets=target 2 at 2.000 mm: 1 reverse\n"
            "points_unsolved unsolved=1 points=6 reason=probe \"B\" is lost\n");
  points.push_back(point(2, -1, 2));  // the point is measured again
  EXPECT_TRUE(all_measured(kTargets_m, 1, points));
  EXPECT_TRUE(missing_notices(kTargets_m, 1, points).empty());
}

TEST(Completeness, ARunWithMostPointsUnsolvedIsNotComplete) {
  std::vector<MeasuredPoint> points(269, point(1, 1, 1, "five probes are needed"));
  points.insert(points.end(), 6, point(1, 1));
  const auto missing = missing_notices({}, 0, points);
  EXPECT_EQ(shown(missing),
            "points_unsolved unsolved=269 points=275 reason=five probes are needed\n");
  EXPECT_TRUE(missing_notices({}, 0, {points.begin() + 263, points.end()}).empty());
}

TEST(Completeness, ARunWithoutTargetsHasNoMissingPoints) {
  EXPECT_TRUE(missing_notices({}, 0, passes(1)).empty());
  EXPECT_FALSE(all_measured({}, 0, passes(1)));  // a run without targets ends when a user stops it
  EXPECT_FALSE(all_measured(kTargets_m, 0, passes(1)));
}

TEST(Completeness, WithoutRepeatsEachTargetIsNeededOnce) {
  EXPECT_TRUE(missing_notices(kTargets_m, 0, {point(1, 1), point(2, 1), point(3, -1)}).empty());
  const auto missing = missing_notices(kTargets_m, 0, {point(1, 1), point(2, 1)});
  EXPECT_EQ(shown(missing), "targets_missing missing=1 of=3 targets=target 3 at 4.100 mm\n");
}

TEST(Completeness, ManyMissingTargetsAreCountedNotListed) {
  const std::vector<double> many(40, 0.0);
  const auto missing = missing_notices(many, 5, {point(1, 1)});
  const std::string text = shown(missing[0]);
  EXPECT_EQ(text.find("points_missing missing=399 of=400 "), 0u) << text;
  EXPECT_TRUE(text.ends_with("; and 34 more targets")) << text;
  EXPECT_LT(text.size(), 400u);
}

// In a run without targets, the target numbers of the points are invalid.
TEST(Completeness, IgnoresInvalidTargetNumbers) {
  EXPECT_FALSE(all_measured(kTargets_m, 1, {point(0, 1), point(99, 1), point(-3, 1)}));
}

}  // namespace
}  // namespace mdof::daemon
