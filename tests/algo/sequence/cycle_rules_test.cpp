// Tests the cycle and the runs of a series of visits, on both sides of the limits. The series are
// defined by hand. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "algo/sequence/sequence_cycle.h"

namespace mdof::algo {
namespace {

using Runs = std::vector<int>;

// The absolute value of a number is the target, its sign is the direction.
std::vector<Visit> visits_of(const std::vector<int>& row) {
  std::vector<Visit> visits;
  for (const int v : row) visits.push_back({std::abs(v), v > 0 ? 1 : -1});
  return visits;
}

// `runs` runs in both directions over seven targets. In the first pass the first `repeated` targets
// are visited twice.
std::vector<int> forward_and_reverse(int runs, int repeated) {
  std::vector<int> row;
  for (int run = 0; run < runs; ++run) {
    for (int t = 1; t <= 7; ++t) row.insert(row.end(), run == 0 && t <= repeated ? 2 : 1, t);
    for (int t = 7; t >= 1; --t) row.push_back(-t);
  }
  return row;
}

bool by_passes(const std::vector<int>& row) {
  return recognise_cycle(visits_of(row), 7).by_passes;
}

TEST(CycleRule, AllowsThreeRepeatedVisitsInAShortRun) {
  EXPECT_TRUE(by_passes(forward_and_reverse(1, 3)));   // 3 of 17 visits
  EXPECT_FALSE(by_passes(forward_and_reverse(1, 4)));  // 4 of 18 visits
}

TEST(CycleRule, AllowsThreeOfTwentyInALongRun) {
  EXPECT_TRUE(by_passes(forward_and_reverse(3, 7)));  // 7 of 49 visits
  // Three visits are out of order: the repeated visits of targets 4, 5 and 6.
  EXPECT_TRUE(by_passes({1, 2, 3, 4, 4, 5, 5, 6, 6, 7, -7, -6, -5, -4, -3, -2, -1}));
  auto more = forward_and_reverse(3, 7);
  more.insert(more.begin(), 1);
  EXPECT_FALSE(by_passes(more));  // 8 of 50 visits
}

// In the first series two visits, 4 and 6, follow a visit in the other direction. In the second
// series only 4 does.
TEST(CycleRule, InterruptedPassIsOutOfOrder) {
  EXPECT_FALSE(by_passes({1, 2, -3, 4, -5, 6, 7, -7, -6, -5, -4, -3, -2, -1}));
  EXPECT_TRUE(by_passes({1, 2, -3, 4, 5, 6, 7, -7, -6, -5, -4, -3, -2, -1}));
}

// A short pass before the first turn is a separate run, in both directions.
TEST(CycleRule, ShortFirstPassIsARun) {
  for (const int up : {1, -1}) {
    const auto at = [&](int target) { return up * (up > 0 ? target : 8 - target); };
    std::vector<int> row = {-at(3), -at(2), -at(1)};
    for (int t = 1; t <= 7; ++t) row.push_back(at(t));
    for (int t = 7; t >= 1; --t) row.push_back(-at(t));
    const Runs expected = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2};
    EXPECT_EQ(recognise_cycle(visits_of(row), 7).run, expected) << up;
    row.erase(row.begin());  // two stops are enough
    EXPECT_EQ(recognise_cycle(visits_of(row), 7).run, Runs(expected.begin() + 1, expected.end()));
    row.erase(row.begin());  // a single stop is no pass
    EXPECT_EQ(recognise_cycle(visits_of(row), 7).run, Runs(15, 1)) << up;
  }
}

// Each target is visited twice in a row. From target to target the axis moves in one direction; one
// of seven motions may be an exception.
TEST(CycleRule, PilgrimMovesInOneDirection) {
  const auto cycle = [](const std::vector<int>& targets, int count) {
    std::vector<int> row;
    for (const int t : targets) row.insert(row.end(), {t, -t});
    return recognise_cycle(visits_of(row), count).cycle;
  };
  EXPECT_EQ(cycle({1, 2, 3, 4, 5}, 5), Cycle::pilgrim);
  EXPECT_EQ(cycle({5, 4, 3, 2, 1}, 5), Cycle::pilgrim);
  EXPECT_NE(cycle({1, 2, 4, 3, 5}, 5), Cycle::pilgrim);
  EXPECT_NE(cycle({5, 4, 2, 3, 1}, 5), Cycle::pilgrim);
  EXPECT_EQ(cycle({1, 2, 3, 5, 4, 6, 7, 8}, 8), Cycle::pilgrim);
  EXPECT_EQ(cycle({8, 7, 6, 4, 5, 3, 2, 1}, 8), Cycle::pilgrim);
  EXPECT_NE(cycle({1, 2, 3, 5, 4, 6, 7}, 7), Cycle::pilgrim);
}

// With up to three targets, a pass has at least one target. With more targets, it has at least half
// of them.
TEST(CycleRule, PassTurnsAtHalfOfTheTargets) {
  const auto runs = [](int targets, const std::vector<int>& row) {
    Passes passes(targets);
    Runs all;
    for (const Visit& v : visits_of(row)) all.push_back(passes.next(v));
    return all;
  };
  EXPECT_EQ(runs(3, {1, 2, -1, 2}), (Runs{1, 1, 1, 2}));
  EXPECT_EQ(runs(4, {1, 2, 3, -2, 3, 4}), (Runs{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(runs(4, {1, 2, 3, -2, -1, 2, 3, 4}), (Runs{1, 1, 1, 1, 1, 2, 2, 2}));
}

// Each target is visited several times in both directions. The numbers of visits are equal, or one
// target has far more visits than the others.
TEST(CycleRule, QuasiPilgrimVisitsAllEquallyOften) {
  const auto cycle = [](const std::vector<int>& times) {
    std::vector<int> row;
    for (int pass = 0; pass < 2; ++pass)
      for (int t = 1; t <= 5; ++t)
        for (int k = 0; k < times[static_cast<std::size_t>(t) - 1]; ++k)
          row.insert(row.end(), {t, -t});
    return recognise_cycle(visits_of(row), 5).cycle;
  };
  EXPECT_EQ(cycle({3, 3, 3, 3, 3}), Cycle::quasi_pilgrim);
  EXPECT_EQ(cycle({9, 1, 1, 1, 1}), Cycle::none);
  EXPECT_EQ(cycle({4, 4, 4, 4, 2}), Cycle::quasi_pilgrim);  // 8 of 72: 4 of 36 visits are missing
  EXPECT_EQ(cycle({4, 4, 4, 3, 2}), Cycle::none);           // 12 of 68
}

}  // namespace
}  // namespace mdof::algo
