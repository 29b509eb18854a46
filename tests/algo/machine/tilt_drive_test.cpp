#include "algo/machine/tilt_drive.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kDeg = 3.14159265358979323846 / 180;
constexpr CoPlanarDrive kDrive{25.84 * kDeg, 17e-3};

// Expected: the numbers of the paper, sections 3.2 to 3.4, and results of Eq. 5 and 6 of the paper.
TEST(TiltDrive, HasTheRatiosAndResolutionsOfThePaper) {
  EXPECT_NEAR(1000 * platform_ratio(kDrive), 900, 0.05);
  EXPECT_NEAR(1000 * platform_ratio({26.34 * kDeg, 17e-3}), 896.2, 0.05);
  EXPECT_NEAR(1000 * platform_ratio({25.34 * kDeg, 17e-3}), 903.8, 0.05);
  EXPECT_NEAR(0.5 * platform_ratio(kDrive), 0.450, 5e-4);
  EXPECT_NEAR(0.5 * spindle_ratio(kDrive), 0.242, 5e-4);
  EXPECT_NEAR(1000 * spindle_ratio(kDrive), 484.3, 0.05);
  const double turns_deg[][2] = {{0, 0.00303}, {15, 0.00314}, {30, 0.00350}, {45, 0.00429}};
  for (const auto& [from, step] : turns_deg)
    EXPECT_NEAR(*rotation_step(kDrive, from * kDeg, 1e-6) / kDeg, step, 5e-6) << from;
}

TEST(TiltDrive, TiltErrorMovesThePlatformWithTheTravel) {
  EXPECT_NEAR(platform_tilt_effect(kDrive, 60e-3, 0.05 * kDeg), -25.4e-6, 0.05e-6);
  EXPECT_NEAR(spindle_tilt_effect(kDrive, 40e-3, 0.05 * kDeg), 89e-6, 0.5e-6);
  // The tilt angle changes while the screw does not move. Expected: differences of the kinematics.
  const CoPlanarDrive other{kDrive.tilt_rad + 1e-6, kDrive.arm_m};
  PlatformMotion at{};
  at[kPlatformX].position = 60e-3;
  at[kPlatformY].position = 40e-3;
  const auto moved = *platform_for(other, *screws_for(kDrive, at));
  EXPECT_NEAR(moved[kPlatformX].position - 60e-3, platform_tilt_effect(kDrive, 60e-3, 1e-6), 1e-13);
  EXPECT_NEAR(moved[kPlatformY].position - 40e-3, spindle_tilt_effect(kDrive, 40e-3, 1e-6), 2e-13);
}

TEST(TiltDrive, ScrewsFollowTheirEquations) {
  PlatformMotion at{};
  at[kPlatformX].position = 10e-3;
  at[kPlatformY].position = -5e-3;
  at[kPlatformZ].position = 4e-3;
  at[kPlatformB].position = 30 * kDeg;
  const auto screws = *screws_for(kDrive, at);
  const double c = std::cos(25.84 * kDeg), end = 17e-3 * 0.5;
  EXPECT_NEAR(screws[kScrewA].position * c, 4e-3 + end, 1e-15);
  EXPECT_NEAR(screws[kScrewB].position * c, 10e-3 + end, 1e-15);
  EXPECT_NEAR(screws[kScrewC].position * c, 4e-3 - end, 1e-15);
  EXPECT_NEAR(screws[kScrewD].position * std::tan(25.84 * kDeg), -5e-3, 1e-15);
}

PlatformMotion motion_at(double t) {  // position of X, Y, Z and B as polynomials of the time
  const double p[4][3] = {
      {0.01, 0.02, 0.3}, {-0.005, 0.01, -0.2}, {0.004, -0.03, 0.1}, {0.5, 0.8, -2}};
  PlatformMotion m;
  for (std::size_t i = 0; i < 4; ++i)
    m[i] = {p[i][0] + p[i][1] * t + p[i][2] * t * t, p[i][1] + 2 * p[i][2] * t, 2 * p[i][2]};
  return m;
}

TEST(TiltDrive, VelocityAndAccelerationAreDerivatives) {
  const double h = 1e-4;
  const auto before = *screws_for(kDrive, motion_at(-h)), now = *screws_for(kDrive, motion_at(0)),
             after = *screws_for(kDrive, motion_at(h));
  const auto back = *platform_for(kDrive, now);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(now[i].velocity, (after[i].position - before[i].position) / (2 * h), 1e-9);
    EXPECT_NEAR(now[i].acceleration, (after[i].velocity - before[i].velocity) / (2 * h), 1e-8);
    EXPECT_NEAR(back[i].position, motion_at(0)[i].position, 1e-15);
    EXPECT_NEAR(back[i].velocity, motion_at(0)[i].velocity, 1e-14);
    EXPECT_NEAR(back[i].acceleration, motion_at(0)[i].acceleration, 1e-13);
  }
}

TEST(TiltDrive, RefusesMotionsBeyondTheArms) {
  PlatformMotion at{};
  at[kPlatformB].position = 90 * kDeg;
  EXPECT_FALSE(screws_for(kDrive, at));
  ScrewMotion screws{};
  screws[kScrewA].position = 20e-3;
  screws[kScrewC].position = -20e-3;
  EXPECT_FALSE(platform_for(kDrive, screws));
  EXPECT_FALSE(rotation_step({kDrive.tilt_rad, 0.5e-6}, 0, 1e-6));
}

}  // namespace
}  // namespace mdof::algo
