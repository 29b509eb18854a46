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

// The curvature of the spline is 0 at its ends. Therefore its slope is wrong by up to 0.43 of the
// change of the slope over one step there, and right in the middle.
TEST(LocalSlopes, AreTheDerivativeOfAParabola) {
  mdof::Run run;
  for (int i = 0; i <= 8; ++i) {
    const double x = i * 5e-3;
    run.points.push_back(point(i + 1, 1, x, 2e-3 * x * x, 0.1 * x));
  }
  const auto slopes = local_slopes(run);
  ASSERT_EQ(slopes.size(), 9u);
  const double change = 4e-3 * 5e-3;
  for (std::size_t i = 0; i <= 8; ++i) {
    const double tolerance = i == 0 || i == 8 ? 0.45 : i == 1 || i == 7 ? 0.13 : 0.04;
    EXPECT_NEAR(slopes[i].slope[0], change * static_cast<double>(i), tolerance * change) << i;
    EXPECT_NEAR(slopes[i].slope[4], 0.1, 1e-12) << i;
    EXPECT_LT(slopes[i].unseen[0], 1e-6 * change) << i;
  }
}

// Root mean square of the stated slopes, relative to that of the derivatives. Waves of a length in
// steps with 40 phases, over even and uneven targets.
double stated_to_true(double length, int targets, double uneven) {
  double stated = 0, truth = 0;
  for (int phase = 0; phase < 40; ++phase) {
    mdof::Run run;
    const double omega = 2 * M_PI / length;
    const auto angle = [&](int i) {
      return omega * (i + uneven * std::sin(i * i)) + phase * M_PI / 20;
    };
    for (int i = 0; i < targets; ++i)
      run.points.push_back(
          point(i + 1, 1, (i + uneven * std::sin(i * i)) * 5e-3, 1e-6 * std::sin(angle(i))));
    const auto slopes = local_slopes(run);
    EXPECT_EQ(slopes.front().unseen, Errors5{});
    EXPECT_EQ(slopes.back().unseen, Errors5{});
    for (int i = 0; i < targets; ++i) {
      const LocalSlope& at = slopes[static_cast<std::size_t>(i)];
      stated += at.slope[0] * at.slope[0] + at.unseen[0] * at.unseen[0];
      truth += std::pow(1e-6 * omega / 5e-3 * std::cos(angle(i)), 2);
    }
  }
  return std::sqrt(stated / truth);
}

TEST(LocalSlopes, ContainTheSlopesOfShortWaves) {
  for (const int targets : {6, 11, 31})
    for (const double uneven : {0.0, 0.3})
      for (const double length : {2.5, 3.0, 3.5, 4.0, 6.0, 20.0}) {
        const double ratio = stated_to_true(length, targets, uneven);
        EXPECT_GT(ratio, 0.95) << length << " steps, " << targets << " targets, " << uneven;
        EXPECT_LT(ratio, length < 3 ? 1.25 : 1.13) << length << " steps, " << targets;
      }
}

// With three or four targets, the roughness of the form is unknown.
TEST(LocalSlopes, OfFewTargetsContainWavesOfUnknownLength) {
  for (const int targets : {3, 4})
    for (const double length : {3.0, 6.0, 20.0}) {
      const double ratio = stated_to_true(length, targets, 0);
      EXPECT_GT(ratio, 0.95) << length << " steps, " << targets << " targets";
      EXPECT_LT(ratio, 1.2) << length << " steps, " << targets << " targets";
    }
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
      for (const LocalSlope& at : local_slopes(run)) EXPECT_NEAR(at.slope[0], sign * 1e-3, 1e-15);
    }
}

// Only one of three targets is also approached in reverse, with a reversal of 10 µm. The reversal
// is no slope.
TEST(LocalSlopes, UseTheSameApproach) {
  mdof::Run run;
  for (int i = 0; i < 3; ++i) run.points.push_back(point(i + 1, 1, i * 0.01, 1e-3 * i * 0.01));
  run.points.push_back(point(2, -1, 0.01, 20e-6));
  const auto slopes = local_slopes(run);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(slopes[i].slope[0], 1e-3, 1e-15) << i;
  // From both approaches, because only one target has this approach.
  EXPECT_NEAR(slopes[3].slope[0], 1e-3, 1e-15);
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
  for (const LocalSlope& at : local_slopes(run)) EXPECT_NEAR(at.slope[0], 1e-3, 1e-5);
}

TEST(LocalSlopes, AreZeroForOnePositionOrNone) {
  EXPECT_TRUE(local_slopes(mdof::Run()).empty());
  mdof::Run run;
  run.points = {point(1, 1, 0.01, 3e-6), point(1, -1, 0.01, 5e-6), point(2, 0, 0.01, 7e-6)};
  for (const LocalSlope& at : local_slopes(run)) {
    EXPECT_EQ(at.slope, Errors5{});
    EXPECT_EQ(at.unseen, Errors5{});
  }
}

// The approach of all stops is unknown.
TEST(LocalSlopes, UseAllPointsForUnknownApproaches) {
  mdof::Run run;
  for (int i = 0; i < 3; ++i) run.points.push_back(point(i + 1, 0, i * 0.01, 2e-3 * i * 0.01));
  for (const LocalSlope& at : local_slopes(run)) EXPECT_NEAR(at.slope[0], 2e-3, 1e-15);
}

}  // namespace
}  // namespace mdof::algo
