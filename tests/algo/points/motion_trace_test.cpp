// Directions of approach of an axis whose positions are known.
#include "algo/points/motion_trace.h"

#include <gtest/gtest.h>

#include <vector>

namespace mdof::algo {
namespace {

// A reversal is a motion back of more than 1.
int heading_after(const std::vector<double>& positions) {
  MotionTrace trace;
  for (const double x : positions) trace.follow(x, 1);
  return trace.heading();
}

// The motion back is measured from the farthest position, before the first motion from the lowest
// and the highest position.
TEST(MotionTrace, ReversesAfterALargerMotionBack) {
  for (const double sign : {1.0, -1.0})
    for (const double from : {0.0, 50.0}) {
      const auto heading = [&](std::vector<double> positions) {
        for (double& x : positions) x = from + sign * x;
        return static_cast<int>(sign) * heading_after(positions);
      };
      EXPECT_EQ(heading({0}), 0);
      EXPECT_EQ(heading({0, 1}), 0);
      EXPECT_EQ(heading({0, 1.01}), 1);
      EXPECT_EQ(heading({0, -0.8, 0.1}), 0);
      EXPECT_EQ(heading({0, -0.8, 0.3}), 1);
      EXPECT_EQ(heading({0, 0.8, 0.3, -0.1}), 0);
      EXPECT_EQ(heading({0, 0.8, 0.3, -0.3}), -1);
      EXPECT_EQ(heading({0, 3, 2.1}), 1);
      EXPECT_EQ(heading({0, 3, 1.9}), -1);
      EXPECT_EQ(heading({0, 3, 5, 4.1}), 1);
      EXPECT_EQ(heading({0, 3, 5, 3.9}), -1);
      EXPECT_EQ(heading({0, 5, 3, 3.9}), -1);
      EXPECT_EQ(heading({0, 5, 3, 4.1}), 1);
      EXPECT_EQ(heading({0, 5, 3, 1, 1.9}), -1);
      EXPECT_EQ(heading({0, 5, 3, 1, 2.1, 1.2}), 1);
      EXPECT_EQ(heading({0, 5, 3, 1, 2.1, 1.05}), -1);
    }
}

TEST(MotionTrace, ForgetsAllAfterClear) {
  MotionTrace trace;
  for (const double x : {0.0, 5.0}) trace.follow(x, 1);
  trace.remember(0, 1);
  trace.clear();
  EXPECT_EQ(trace.heading(), 0);
  EXPECT_EQ(trace.by_path(9, 1), 0);
  trace.follow(7, 1);
  EXPECT_EQ(trace.heading(), 0);
}

// The path has the positions 0, 10, 20, 5. A position must be at least 3 from the last one.
TEST(MotionTrace, PathGivesTheDirectionFromAFarPosition) {
  MotionTrace trace;
  EXPECT_EQ(trace.by_path(1, 0), 0);
  for (const double x : {0.0, 2.9, 10.0, 7.1, 20.0, 5.0, 7.9}) trace.remember(x, 3);
  EXPECT_EQ(trace.by_path(6, 0.9), 1);    // from 5
  EXPECT_EQ(trace.by_path(6, 1.1), -1);   // from 20
  EXPECT_EQ(trace.by_path(4, 0.9), -1);   // from 5
  EXPECT_EQ(trace.by_path(6, 13.9), -1);  // from 20
  EXPECT_EQ(trace.by_path(6, 14.1), 0);
  EXPECT_EQ(trace.by_path(12, 7.9), -1);  // from 20
  EXPECT_EQ(trace.by_path(12, 8.1), 1);   // from 0
  EXPECT_EQ(trace.by_path(8, 3), -1);     // 3 from 5, so from 20
}

TEST(MotionTrace, PathHas64Positions) {
  MotionTrace trace;
  trace.remember(1000, 1);
  for (int i = 0; i < 63; ++i) trace.remember(2 * (i % 2), 1);
  EXPECT_EQ(trace.by_path(1, 100), -1);
  trace.remember(4, 1);
  EXPECT_EQ(trace.by_path(1, 100), 0);
}

// The axis moves from 0 past 10 to `past` and back to 10.
TEST(MotionTrace, SmallCorrectionKeepsTheDirectionOfTheMotion) {
  for (const double sign : {1.0, -1.0}) {
    const auto direction = [&](double past, double start) {
      MotionTrace trace;
      for (const double x : {start, past, 10.0}) trace.follow(sign * x, 0.5);
      EXPECT_EQ(trace.heading(), -static_cast<int>(sign));
      const double low = sign > 0 ? start : -past, high = sign > 0 ? past : -start;
      return static_cast<int>(sign) * trace.by_last_motion(sign * 10, 3, low, high);
    };
    EXPECT_EQ(direction(12.9, 0), 1);
    EXPECT_EQ(direction(13.1, 0), -1);  // more than 3 past the position
    EXPECT_EQ(direction(12, 5.9), 1);   // 2 past, from 4.1
    EXPECT_EQ(direction(12, 6.1), -1);  // 2 past, from 3.9
    MotionTrace straight;
    for (const double x : {0.0, 5.0, 10.0}) straight.follow(sign * x, 0.5);
    EXPECT_EQ(straight.by_last_motion(sign * 10, 3, sign > 0 ? 0 : -10, sign > 0 ? 10 : 0), sign);
  }
  EXPECT_EQ(MotionTrace().by_last_motion(0, 1, 0, 0), 0);
}

}  // namespace
}  // namespace mdof::algo
