#include "algo/uncertainty/statistics/local_slopes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

MeasuredPoint point(int target, int direction, double position_m, double dy_m, double ez = 0) {
  MeasuredPoint p;
  p.target = target;
  p.point.direction = direction;
  p.point.position_m = position_m;
  p.errors.valid = true;
  p.errors.local = {dy_m, 0, 0, 0, ez};
  return p;
}

TEST(LocalSlopes, AreTheDerivativeOfAParabola) {
  mdof::Run run;
  for (int i = 0; i <= 8; ++i) {
    const double x = i * 5e-3;
    run.points.push_back(point(i + 1, 1, x, 2e-3 * x * x, 0.1 * x));
  }
  const auto slopes = local_slopes(run);
  ASSERT_EQ(slopes.size(), 9u);
  for (std::size_t i = 1; i < 8; ++i)
    EXPECT_NEAR(slopes[i][0], 4e-3 * static_cast<double>(i) * 5e-3, 1e-15) << i;
  // Slope of the chord, because this target has one neighbour.
  EXPECT_NEAR(slopes[0][0], 2e-3 * 5e-3, 1e-15);
  EXPECT_NEAR(slopes[8][0], 2e-3 * 75e-3, 1e-15);
  for (const Errors5& slope : slopes) EXPECT_NEAR(slope[4], 0.1, 1e-12);
}

// The slopes are derivatives with respect to the travel of the target in M. Tested for a moving
// fixture or a moving target, and for both directions of the encoder.
TEST(LocalSlopes, FollowTheTravelOfTheTarget) {
  for (const bool fixture_moves : {false, true})
    for (const bool against : {false, true}) {
      mdof::Run run;
      run.header.sides.fixture_moves = fixture_moves;
      run.header.sides.against_encoder = against;
      for (const double x : {0.0, 0.01, 0.03})
        run.points.push_back(point(static_cast<int>(x * 100) + 1, 1, x, 1e-3 * x));
      const double sign = fixture_moves == against ? 1 : -1;
      for (const Errors5& slope : local_slopes(run)) EXPECT_NEAR(slope[0], sign * 1e-3, 1e-15);
    }
}

// Only one of three targets is also approached in reverse, with a reversal of 10 µm. The reversal
// is no slope.
TEST(LocalSlopes, UseTheSameApproach) {
  mdof::Run run;
  for (int i = 0; i < 3; ++i) run.points.push_back(point(i + 1, 1, i * 0.01, 1e-3 * i * 0.01));
  run.points.push_back(point(2, -1, 0.01, 20e-6));
  const auto slopes = local_slopes(run);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(slopes[i][0], 1e-3, 1e-15) << i;
  // From both approaches, because only one target has this approach.
  EXPECT_NEAR(slopes[3][0], 1e-3, 1e-15);
}

// Positions: two pairs of targets at the same place or nearly so, a short interval, and a point
// without errors.
TEST(LocalSlopes, AcceptEqualAndUnequalPositions) {
  mdof::Run run;
  const double places[] = {0, 1e-9, 0.02, 0.021, 0.06, 0.06};
  for (int i = 0; i < 6; ++i)
    for (const double noise : {5e-9, -4e-9})
      run.points.push_back(point(i + 1, 1, places[i], 1e-3 * places[i] + (i % 2 ? noise : -noise)));
  run.points.push_back(run.points.back());
  run.points.back().errors.valid = false;
  run.points.back().errors.local[0] = std::nan("");
  for (const Errors5& slope : local_slopes(run)) EXPECT_NEAR(slope[0], 1e-3, 1e-5);
}

TEST(LocalSlopes, AreZeroForOnePositionOrNone) {
  EXPECT_TRUE(local_slopes(mdof::Run()).empty());
  mdof::Run run;
  run.points = {point(1, 1, 0.01, 3e-6), point(1, -1, 0.01, 5e-6), point(2, 0, 0.01, 7e-6)};
  for (const Errors5& slope : local_slopes(run)) EXPECT_EQ(slope, Errors5{});
}

// The approach of all stops is unknown.
TEST(LocalSlopes, UseAllPointsForUnknownApproaches) {
  mdof::Run run;
  for (int i = 0; i < 3; ++i) run.points.push_back(point(i + 1, 0, i * 0.01, 2e-3 * i * 0.01));
  for (const Errors5& slope : local_slopes(run)) EXPECT_NEAR(slope[0], 2e-3, 1e-15);
}

}  // namespace
}  // namespace mdof::algo
