// Tests stops without a point, and targets that are all visited again at a constant distance. The
// stops are defined by hand. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "algo/plausibility/plausibility.h"
#include "algo/sequence/shifted_targets.h"

namespace mdof::algo {
namespace {

using PassedOver = DwellDetector::Summary::PassedOver;

// Visits in intervals of a second. `order` contains the target number of each visit.
Sequence visited(const std::vector<double>& targets_m, const std::vector<int>& order) {
  Sequence sequence;
  sequence.targets_m = targets_m;
  for (std::size_t i = 0; i < order.size(); ++i) {
    MeasuredPoint p;
    p.target = order[i];
    p.point.position_m = targets_m[static_cast<std::size_t>(order[i]) - 1];
    p.point.begin_ns = 1'000'000'000LL * static_cast<std::int64_t>(i);
    p.point.end_ns = p.point.begin_ns + 400'000'000;
    sequence.points.push_back(p);
  }
  return sequence;
}

std::size_t lost(const Sequence& sequence, double position_m, std::int64_t begin_ns) {
  const Rig rig;
  DwellDetector::Summary dwells;
  dwells.passed_over.push_back({position_m, 0.05, begin_ns, true});
  return lost_stops({rig, sequence, dwells}).size();
}

TEST(LostStops, HaveNoAdjacentPointOfTheirTarget) {
  const Sequence s = visited({0, 10e-3, 20e-3, 30e-3}, {1, 2, 4});
  // Between the points of targets 2 and 4; target 3 has no point.
  EXPECT_EQ(lost(s, 20e-3, 1'500'000'000), 1u);
  EXPECT_EQ(lost(s, 10e-3, 1'500'000'000), 0u);  // again at target 2, directly after its point
  EXPECT_EQ(lost(s, 30e-3, 1'500'000'000), 0u);  // at target 4, directly before its point
  EXPECT_EQ(lost(s, 0, 1'500'000'000), 1u);      // at target 1, not beside its point
  EXPECT_EQ(lost(s, 25e-3, 1'500'000'000), 0u);  // at no target
  EXPECT_EQ(lost(s, 0, -1), 0u);                 // before all points, at the target of the first
  EXPECT_EQ(lost(s, 30e-3, -1), 1u);
  EXPECT_EQ(lost(s, 30e-3, 9'000'000'000), 0u);  // after all points, at the target of the last
  EXPECT_EQ(lost(s, 10e-3, 9'000'000'000), 1u);
  EXPECT_EQ(lost(visited({}, {}), 0, 0), 0u);
}

TEST(ShiftedTargets, AreFoundWithTimeAndShift) {
  const double d = 2e-3;
  const auto shifted = find_shifted_targets(
      visited({0, d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d}, {1, 3, 5, 3, 6, 4, 2}));
  ASSERT_TRUE(shifted);
  EXPECT_EQ(shifted->time_ns, 3'400'000'000);
  EXPECT_NEAR(shifted->shift_m, d, 1e-12);
  const auto back =
      find_shifted_targets(visited({0, d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d}, {2, 4, 6, 5, 3, 1}));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->shift_m, -d, 1e-12);
}

// One direction has one more target. The shift is calculated from the common targets.
TEST(ShiftedTargets, MayHaveOneMoreTargetInOneDirection) {
  const double d = 2e-3;
  EXPECT_NEAR(find_shifted_targets(
                  visited({0, d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d, 45e-3}, {1, 3, 5, 7, 6, 4, 2}))
                  ->shift_m,
              d, 1e-12);
  EXPECT_NEAR(
      find_shifted_targets(
          visited({d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d, 45e-3, 45e-3 + d}, {2, 4, 6, 7, 5, 3, 1}))
          ->shift_m,
      d, 1e-12);
}

TEST(ShiftedTargets, AreNotFoundIfTheShiftsDiffer) {
  const double d = 2e-3;
  for (const double off_m : {49e-6, 51e-6}) {  // one target deviates by less or more than 50 um
    for (const std::size_t which : {3u, 5u}) {
      std::vector<double> targets = {0, d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d};
      targets[which] += off_m;
      EXPECT_EQ(find_shifted_targets(visited(targets, {1, 3, 5, 6, 4, 2})).has_value(),
                off_m < 50e-6);
    }
  }
  // Two targets in each direction are too few. If a target has visits in both directions, there is
  // no shift.
  EXPECT_FALSE(find_shifted_targets(visited({0, d, 10e-3, 10e-3 + d}, {1, 3, 4, 2})));
  EXPECT_FALSE(find_shifted_targets(
      visited({0, d, 10e-3, 10e-3 + d, 25e-3, 25e-3 + d}, {1, 3, 5, 6, 4, 2, 1, 3, 5})));
  EXPECT_FALSE(find_shifted_targets(visited({0, 10e-3, 20e-3}, {1, 2, 3, 3, 2, 1})));
  // If the shift is at least half of the range, the visits are taken as another part of the axis.
  for (const double far_m : {9.9e-3, 10.1e-3})
    EXPECT_EQ(find_shifted_targets(
                  visited({0, 3e-3, far_m, 3e-3 + far_m, 20e-3, 20e-3 + far_m}, {1, 2, 5, 6, 4, 3}))
                  .has_value(),
              far_m < 10e-3);
}

}  // namespace
}  // namespace mdof::algo
