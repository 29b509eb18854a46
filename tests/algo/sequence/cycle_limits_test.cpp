// Tests the rules by which cycles are recognised, on both sides of each limit. The series of visits
// are defined by hand. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "algo/sequence/sequence_cycle.h"

namespace mdof::algo {
namespace {

using Row = std::vector<int>;

// The absolute value of a number is the target, its sign is the direction.
std::vector<Visit> signed_visits(const Row& row) {
  std::vector<Visit> visits;
  for (const int v : row) visits.push_back({std::abs(v), v > 0 ? 1 : -1});
  return visits;
}

CycleFound cycle_of(const Row& row, int targets) {
  return recognise_cycle(signed_visits(row), targets);
}

// Each target is visited once from below and once from above.
CycleFound there_and_back(const Row& targets, int count) {
  Row row;
  for (const int t : targets) row.insert(row.end(), {t, -t});
  return cycle_of(row, count);
}

// There may be more blocks (consecutive visits of one target) than targets, because the axis
// returned once: one block more, or a quarter of the number of targets more.
TEST(PilgrimLimit, AllowsAQuarterMoreBlocksThanTargets) {
  EXPECT_EQ(there_and_back({1, 2, 3, 4, 3, 5, 6, 7}, 7).cycle, Cycle::pilgrim);
  EXPECT_NE(there_and_back({1, 2, 3, 4, 3, 4, 5, 6, 7}, 7).cycle, Cycle::pilgrim);
  EXPECT_EQ(there_and_back({1, 2, 3, 4, 5, 4, 5, 6, 7, 8, 9}, 9).cycle, Cycle::pilgrim);
  EXPECT_NE(there_and_back({1, 2, 3, 4, 5, 3, 4, 5, 6, 7, 8, 9}, 9).cycle, Cycle::pilgrim);
}

// In the first cycle, three of six targets are visited twice in a row (nine visits), in the second
// cycle only two (eight visits).
TEST(PilgrimLimit, HalfOfTheTargetsAreVisitedTwiceInARow) {
  const CycleFound found = cycle_of({1, -1, 2, 3, -3, 4, 5, -5, 6}, 6);
  EXPECT_EQ(found.cycle, Cycle::pilgrim);
  EXPECT_FALSE(found.by_passes);
  EXPECT_EQ(found.run, Row(9, 1));
  EXPECT_NE(cycle_of({1, -1, 2, 3, -3, 4, 5, 6}, 6).cycle, Cycle::pilgrim);
}

// Two passes over eight targets, first with eight visits in all, then with seven.
TEST(PassLimit, PassHasHalfOfTheTargetsOnAverage) {
  EXPECT_TRUE(cycle_of({1, 3, 6, 8, -7, -5, -4, -2}, 8).by_passes);
  EXPECT_FALSE(cycle_of({1, 3, 6, 8, -7, -5, -2}, 8).by_passes);
}

// With seven targets, a pass ends when the axis has returned by three targets.
TEST(PassLimit, TurnsAfterHalfOfTheTargets) {
  const auto last_run = [](const Row& row) {
    Passes passes(7);
    int run = 0;
    for (const Visit& v : signed_visits(row)) run = passes.next(v);
    return run;
  };
  EXPECT_EQ(last_run({1, 2, 3, 4, 5, 6, 7, -6, -5, 6}), 1);
  EXPECT_EQ(last_run({1, 2, 3, 4, 5, 6, 7, -6, -5, -4, 5}), 2);
  EXPECT_EQ(last_run({-7, -6, -5, -4, -3, -2, -1, 2, 3, -2}), 1);
  EXPECT_EQ(last_run({-7, -6, -5, -4, -3, -2, -1, 2, 3, 4, -3}), 2);
}

// The turns at the ends distinguish the cycles. A pendulum visits the end target once per turn, a
// standard cycle visits it in both directions. The majority of the turns decides.
TEST(Turns, TurnsAtTheEndsDecide) {
  const Row down = {-7, -6, -5, -4, -3, -2, -1};
  const auto joined = [](std::initializer_list<Row> parts) {
    Row row;
    for (const Row& part : parts) row.insert(row.end(), part.begin(), part.end());
    return row;
  };
  // The turn -1, 3 occurs twice, with target 2 missing. The turn 7, -7 occurs once.
  EXPECT_EQ(cycle_of(joined({down, {3, 4, 5, 6, 7}, down, {3, 4, 5, 6, 7}}), 7).cycle,
            Cycle::pendulum);
  // The turn 7, -6 occurs once. The turn -2, 1 occurs once; there the axis turned beyond target 1.
  EXPECT_EQ(cycle_of({1, 2, 3, 4, 5, 6, 7, -6, -5, -4, -3, -2, 1, 2, 3, 4, 5, 6, 7}, 7).cycle,
            Cycle::standard);
  // The visits 3, -2, 3 are no turn at an end; the visits 7, -7 are such a turn.
  EXPECT_EQ(cycle_of({1, 2, 3, -2, 3, 4, 5, 6, 7, -7, -6, -5, -4, -3, -2, -1}, 7).cycle,
            Cycle::standard);
}

// Each group of targets is visited twice from below, and twice from above in the same order.
Cycle group_cycle(const std::vector<Row>& groups, int targets) {
  Row row;
  for (const Row& group : groups) {
    for (int k = 0; k < 4; ++k)
      for (const int t : group) row.push_back(k % 2 == 0 ? t : -t);
  }
  return cycle_of(row, targets).cycle;
}

// Between the visits of a target, the axis must move over at most half of all targets. This must be
// true for most targets.
TEST(QuasiPilgrimLimit, StaysWithinHalfOfTheTargets) {
  EXPECT_EQ(group_cycle({{1, 2, 3, 4}, {5, 6, 7, 8}}, 8), Cycle::quasi_pilgrim);
  // Between the visits of a target the axis moves over 5 targets (for five of the nine targets) or
  // over 4 targets (for the other four). The median is 5.
  EXPECT_EQ(group_cycle({{1, 2, 3, 4}, {5, 6, 7, 8, 9}}, 9), Cycle::none);
  EXPECT_EQ(group_cycle({{1, 2, 3, 4, 5}, {6, 7, 8, 9}}, 9), Cycle::none);
  // The axis moves over 3 targets (for five targets) or over 9 (for four). The median is 3.
  EXPECT_EQ(group_cycle({{2, 4}, {9, 1, 3, 5}, {6, 7, 8}}, 9), Cycle::quasi_pilgrim);
}

// Between the first and the last visit of each target, the axis is four targets away.
TEST(QuasiPilgrimLimit, EveryVisitUpToTheLastCounts) {
  EXPECT_EQ(cycle_of({1, 5, -1, -5, 2, 6, -2, -6, 3, 7, -3, -7, 4, 8, -4, -8}, 8).cycle,
            Cycle::none);
}

// The passes go over all six targets. In each pass every second target is visited twice in a row:
// 24 blocks of 36 visits, two thirds. Without one visit, 24 blocks of 35 are more than two thirds.
TEST(QuasiPilgrimLimit, ThirdOfTheVisitsTurnsAtATarget) {
  Row row = {1,  -1, 2,  3,  -3, 4,  5,  -5, 6,   //
             1,  2,  -2, 3,  4,  -4, 5,  6,  -6,  //
             1,  -1, -2, 3,  -3, -4, 5,  -5, -6,  //
             -1, 2,  -2, -3, 4,  -4, -5, 6,  -6};
  EXPECT_EQ(cycle_of(row, 6).cycle, Cycle::quasi_pilgrim);
  row.erase(row.begin() + 1);
  EXPECT_EQ(cycle_of(row, 6).cycle, Cycle::none);
}

}  // namespace
}  // namespace mdof::algo
