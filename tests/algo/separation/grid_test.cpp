// Tests the positions of set-ups on a common grid, with values calculated by hand.
#include "algo/separation/grid.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

using SetUps = std::vector<SetUp>;  // each test class has a member SetUp

SetUp at_positions(std::vector<double> position_m, double shift_m = 0) {
  SetUp set_up;
  set_up.error_m.assign(position_m.size(), 0);
  set_up.position_m = std::move(position_m);
  set_up.shift_m = shift_m;
  return set_up;
}

// The shift differs by 0.4 mm from a multiple of the step of 10 mm.
TEST(SeparationGrid, AcceptsAShiftWithinTheMatch) {
  const std::vector<double> x = {0, 10e-3, 20e-3, 30e-3};
  const SetUps set_ups = {at_positions(x), at_positions(x, 20.4e-3)};
  const auto grid = grid_of({}, set_ups, 0.41e-3);
  ASSERT_TRUE(grid) << grid.error().message;
  EXPECT_NEAR(grid->step_m, 10e-3, 1e-15);
  EXPECT_EQ(grid->at_position, (std::vector<std::size_t>{0, 1, 2, 3, 0, 1, 2, 3}));
  // If the target moves in the direction +, the probe measures lower places of the target. If the
  // target is shifted by two steps in the direction +, the places are two steps lower.
  EXPECT_EQ(grid->at_place, (std::vector<std::size_t>{5, 4, 3, 2, 3, 2, 1, 0}));
  ASSERT_EQ(grid->place_m.size(), 6u);
  EXPECT_NEAR(grid->place_m[5] - grid->place_m[0], 50e-3, 1e-15);
  const auto refused = grid_of({}, set_ups, 0.39e-3);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find(
                "set-up 2: the shift of 20.4 mm is 0.4 mm away from a multiple of the step of 10 "
                "mm"),
            std::string::npos)
      << refused.error().message;
}

// Positions that differ by at most the match tolerance from the lowest of them are one position, at
// their mean.
TEST(SeparationGrid, MergesPositionsWithinTheMatch) {
  const auto grid = grid_of(
      {}, {at_positions({0, 10e-3, 25e-3}), at_positions({0.2e-3, 10.3e-3, 25e-3})}, 0.31e-3);
  ASSERT_TRUE(grid) << grid.error().message;
  ASSERT_EQ(grid->position_m.size(), 3u);
  EXPECT_NEAR(grid->position_m[0], 0.1e-3, 1e-15);
  EXPECT_NEAR(grid->position_m[1], 10.15e-3, 1e-15);
  EXPECT_EQ(grid->at_position, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(grid->at_place, (std::vector<std::size_t>{2, 1, 0, 2, 1, 0}));  // no shift
  const auto apart = grid_of(
      {}, {at_positions({0, 10e-3, 25e-3}), at_positions({0.2e-3, 10.3e-3, 25e-3})}, 0.29e-3);
  EXPECT_EQ(apart->position_m.size(), 4u);
  EXPECT_FALSE(
      grid_of({}, {at_positions({0, 0.1e-3, 5e-3})}, 0.31e-3));  // two positions are too few
}

// A step is a difference of positions, so the origin has no effect. A position that is no multiple
// of the step is reported.
TEST(SeparationGrid, StepsDoNotDependOnTheOrigin) {
  for (const double from_m : {-50e-3, -20e-3, 0.0, 70e-3}) {
    std::vector<double> x = {from_m, from_m + 10e-3, from_m + 20e-3, from_m + 40e-3};
    const auto grid = grid_of({}, {at_positions(x), at_positions(x, 10e-3)}, 0.1e-3);
    ASSERT_TRUE(grid) << from_m << " " << grid.error().message;
    EXPECT_NEAR(grid->step_m, 10e-3, 1e-15) << from_m;
    x[2] += 0.3e-3;
    const auto uneven = grid_of({}, {at_positions(x), at_positions(x, 10e-3)}, 0.1e-3);
    ASSERT_FALSE(uneven);
    EXPECT_NE(uneven.error().message.find("not equally spaced"), std::string::npos)
        << uneven.error().message;
  }
}

}  // namespace
}  // namespace mdof::algo
