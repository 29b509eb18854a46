// Where the axis is parked before the first target and after the last target, and where it turns,
// is no target. The stops are those of an axis with 13 targets, 5 mm apart.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "algo/sequence/sequence.h"
#include "schema/sample.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr double kInterval_m = 5e-3;
constexpr int kPlannedTargets = 13;

// The stops of an axis, each with its path from the stop before.
struct Path {
  std::vector<Point> stops;
  double at_m = 0, low_m = 0, high_m = 0;

  explicit Path(double from_m) : at_m(from_m), low_m(from_m), high_m(from_m) {}
  int move_to(double to_m) {
    const int direction = to_m > at_m ? 1 : -1;
    at_m = to_m;
    low_m = std::min(low_m, to_m);
    high_m = std::max(high_m, to_m);
    return direction;
  }
  void stop(double to_m) {
    Point p;
    p.direction = to_m == at_m ? 0 : move_to(to_m);
    p.position_m = to_m;
    p.begin_ns = static_cast<std::int64_t>(stops.size()) * 1'000'000'000;
    p.samples = 100;
    p.travel_min_m = low_m;
    p.travel_max_m = high_m;
    low_m = high_m = to_m;
    stops.push_back(p);
  }
};

// `beyond_m`: distance of the parked axis and of the turns from the end targets.
Sequence measured(int runs, double beyond_m, bool dwells_at_turns) {
  const double end_m = (kPlannedTargets - 1) * kInterval_m;
  Path path(-beyond_m);
  path.stop(-beyond_m);
  for (int run = 1; run <= runs; ++run) {
    for (int t = 0; t < kPlannedTargets; ++t) path.stop(t * kInterval_m);
    path.move_to(end_m + beyond_m);
    if (dwells_at_turns) path.stop(end_m + 1.0000001 * beyond_m);
    for (int t = kPlannedTargets - 1; t >= 0; --t) path.stop(t * kInterval_m);
    path.move_to(-beyond_m);
    if (dwells_at_turns || run == runs) path.stop(-1.0000001 * beyond_m);
  }
  return recognise_sequence(path.stops, {});
}

TEST(ParkedAxis, IsNoTarget) {
  for (const int runs : {1, 2, 3, 5, 10}) {
    for (const double mm : {1.0, 3.0, 5.0}) {
      for (const bool dwells : {false, true}) {
        // A turn with a stop, or a single run, at a distance of one interval: see below. Turns with
        // stops at 0.6 of the interval may be the end targets of a pendulum cycle.
        if (mm > 3 && (dwells || runs == 1)) continue;
        if (mm > 1 && dwells) continue;
        const Sequence s = measured(runs, mm * 1e-3, dwells);
        const std::string what = std::to_string(runs) + " " + std::to_string(mm);
        EXPECT_EQ(s.targets, kPlannedTargets) << what;
        EXPECT_EQ(s.points.size(), 26u * static_cast<unsigned>(runs)) << what;
        EXPECT_EQ(s.cycle, Cycle::standard) << what;
        EXPECT_EQ(s.runs, runs) << what;
        EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_parked_at_start)) << what;
        EXPECT_FALSE(test::has(s.notices, NoticeCode::end_target_assumed)) << what;
      }
    }
  }
}

// A single run that begins and ends one interval before the first target: the log could also begin
// at a target. A notice names the target.
TEST(ParkedAxis, OneIntervalAwayIsReportedAsATarget) {
  const Sequence s = measured(1, kInterval_m, false);
  EXPECT_EQ(s.targets, kPlannedTargets + 1);
  ASSERT_TRUE(test::has(s.notices, NoticeCode::end_target_assumed)) << test::shown(s.notices);
  for (const Notice& n : s.notices) {
    if (n.code != NoticeCode::end_target_assumed) continue;
    EXPECT_EQ(std::get<double>(n.values[0].second), 1);
    EXPECT_NEAR(std::get<double>(n.values[1].second), -5, 1e-9);
  }
}

// The log begins at the first target of a standard cycle, or of a pendulum cycle with an uneven
// first interval.
TEST(ParkedAxis, AtATargetIsATarget) {
  for (const int runs : {1, 2, 3}) {
    for (const bool pendulum : {false, true}) {
      const double first_m = pendulum && runs > 1 ? 1.5e-3 : 0;
      Path path(first_m);
      path.stop(first_m);
      for (int run = 1; run <= runs; ++run) {
        for (int t = run > 1 && !pendulum ? 0 : 1; t < kPlannedTargets; ++t)
          path.stop(t * kInterval_m);
        if (!pendulum) path.move_to(61e-3);
        for (int t = kPlannedTargets - (pendulum ? 2 : 1); t > 0; --t) path.stop(t * kInterval_m);
        path.stop(first_m);
        if (!pendulum) path.move_to(-1e-3);
      }
      const Sequence s = recognise_sequence(path.stops, {});
      EXPECT_EQ(s.targets, kPlannedTargets) << runs << pendulum;
      EXPECT_EQ(s.points.size(), path.stops.size()) << runs << pendulum << test::shown(s.notices);
      EXPECT_EQ(s.cycle, pendulum ? Cycle::pendulum : Cycle::standard);
    }
  }
}

}  // namespace
}  // namespace mdof::algo
