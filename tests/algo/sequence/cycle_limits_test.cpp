// Cycles on both sides of the limits of their rules, with rows of visits made by hand. Mutation
// tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "algo/sequence/sequence_cycle.h"

namespace mdof::algo {
namespace {

using Row = std::vector<int>;

// Each number is a target with the sign of the direction.
std::vector<Visit> signed_visits(const Row& row) {
  std::vector<Visit> visits;
  for (const int v : row) visits.push_back({std::abs(v), v > 0 ? 1 : -1});
  return visits;
}

CycleFound cycle_of(const Row& row, int targets) {
  return recognise_cycle(signed_visits(row), targets);
}

// Each target once from below and once from above.
CycleFound there_and_back(const Row& targets, int count) {
  Row row;
  for (const int t : targets) row.insert(row.end(), {t, -t});
  return cycle_of(row, count);
}

// There may be one more block of visits than targets, or a quarter of the targets more: the axis
// went back once.
TEST(PilgrimLimit, AllowsAQuarterMoreBlocksThanTargets) {
  EXPECT_EQ(there_and_back({1, 2, 3, 4, 3, 5, 6, 7}, 7).cycle, Cycle::pilgrim);
  EXPECT_NE(there_and_back({1, 2, 3, 4, 3, 4, 5, 6, 7}, 7).cycle, Cycle::pilgrim);
  EXPECT_EQ(there_and_back({1, 2, 3, 4, 5, 4, 5, 6, 7, 8, 9}, 9).cycle, Cycle::pilgrim);
  EXPECT_NE(there_and_back({1, 2, 3, 4, 5, 3, 4, 5, 6, 7, 8, 9}, 9).cycle, Cycle::pilgrim);
}

// Six targets with nine visits, three of them twice in a row; then with eight visits.
TEST(PilgrimLimit, HalfOfTheTargetsAreVisitedTwiceInARow) {
  const CycleFound found = cycle_of({1, -1, 2, 3, -3, 4, 5, -5, 6}, 6);
  EXPECT_EQ(found.cycle, Cycle::pilgrim);
  EXPECT_FALSE(found.by_passes);
  EXPECT_EQ(found.run, Row(9, 1));
  EXPECT_NE(cycle_of({1, -1, 2, 3, -3, 4, 5, 6}, 6).cycle, Cycle::pilgrim);
}

// Two passes over eight targets with eight visits in all, then with seven.
TEST(PassLimit, PassHasHalfOfTheTargetsOnAverage) {
  EXPECT_TRUE(cycle_of({1, 3, 6, 8, -7, -5, -4, -2}, 8).by_passes);
  EXPECT_FALSE(cycle_of({1, 3, 6, 8, -7, -5, -2}, 8).by_passes);
}

// Seven targets: a pass turns when the axis has gone back by three.
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

// The turns at the ends decide: a pendulum visits the end target once per turn, a standard cycle in
// both directions. The majority of the turns decides.
TEST(Turns, TurnsAtTheEndsDecide) {
  const Row down = {-7, -6, -5, -4, -3, -2, -1};
  const auto joined = [](std::initializer_list<Row> parts) {
    Row row;
    for (const Row& part : parts) row.insert(row.end(), part.begin(), part.end());
    return row;
  };
  // -1, 3 twice, where target 2 is missing; 7, -7 once.
  EXPECT_EQ(cycle_of(joined({down, {3, 4, 5, 6, 7}, down, {3, 4, 5, 6, 7}}), 7).cycle,
            Cycle::pendulum);
  // 7, -6 once, and -2, 1 once, where the axis turned beyond 1.
  EXPECT_EQ(cycle_of({1, 2, 3, 4, 5, 6, 7, -6, -5, -4, -3, -2, 1, 2, 3, 4, 5, 6, 7}, 7).cycle,
            Cycle::standard);
  // 3, -2, 3 is no turn at an end; 7, -7 is a turn.
  EXPECT_EQ(cycle_of({1, 2, 3, -2, 3, 4, 5, 6, 7, -7, -6, -5, -4, -3, -2, -1}, 7).cycle,
            Cycle::standard);
}

// Each group of targets is visited twice upwards and twice in the same order from above.
Cycle group_cycle(const std::vector<Row>& groups, int targets) {
  Row row;
  for (const Row& group : groups) {
    for (int k = 0; k < 4; ++k)
      for (const int t : group) row.push_back(k % 2 == 0 ? t : -t);
  }
  return cycle_of(row, targets).cycle;
}

// Most targets are visited while the axis stays within half of the targets.
TEST(QuasiPilgrimLimit, StaysWithinHalfOfTheTargets) {
  EXPECT_EQ(group_cycle({{1, 2, 3, 4}, {5, 6, 7, 8}}, 8), Cycle::quasi_pilgrim);
  // Five of nine targets within 5, four within 4: the median is 5.
  EXPECT_EQ(group_cycle({{1, 2, 3, 4}, {5, 6, 7, 8, 9}}, 9), Cycle::none);
  EXPECT_EQ(group_cycle({{1, 2, 3, 4, 5}, {6, 7, 8, 9}}, 9), Cycle::none);
  // Five within 3, four within 9: the median is 3.
  EXPECT_EQ(group_cycle({{2, 4}, {9, 1, 3, 5}, {6, 7, 8}}, 9), Cycle::quasi_pilgrim);
}

// Between the first and the last visit of each target, the axis was four targets away.
TEST(QuasiPilgrimLimit, EveryVisitUpToTheLastCounts) {
  EXPECT_EQ(cycle_of({1, 5, -1, -5, 2, 6, -2, -6, 3, 7, -3, -7, 4, 8, -4, -8}, 8).cycle,
            Cycle::none);
}

// Repeatedly over all six targets; in each pass every second target is visited twice in a row: 24
// blocks of 36 visits, two thirds. Then 35 visits.
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
