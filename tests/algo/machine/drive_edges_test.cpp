// Reach of the arms of a tilt drive, and requirements and results of circular readings of a rotary
// table.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "algo/machine/geometric_tests/perpendicularity.h"
#include "algo/machine/tilt_drive.h"
#include "tests/algo/no_pattern.h"

namespace mdof::algo {
namespace {

// The angles have no pattern. The test calculates the coefficients and their u by the inverse of
// the normal equations.
TEST(PerpendicularityEdges, UnevenAnglesHaveTheirOwnU) {
  test::NoPattern random(9);
  CircleReadings r;
  r.radius_m = 0.07;
  const int highest = 2;
  Eigen::MatrixXd A(25, 5);
  Eigen::VectorXd h(25);
  for (int i = 0; i < 25; ++i) {
    const double a = 0.25 * i + random.between(0, 0.2);
    A.row(i) << 1, std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a);
    h[i] = random.between(-1e-6, 1e-6);
    r.angle_rad.push_back(a);
    r.height_m.push_back(h[i]);
  }
  const Eigen::MatrixXd inverse = (A.transpose() * A).fullPivLu().inverse();
  const Eigen::VectorXd x = inverse * A.transpose() * h;
  const double s = (h - A * x).norm() / std::sqrt(20.0);
  const auto p = perpendicularity(r, highest);
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_NEAR(p->mean_m, x[0], 1e-16);
  EXPECT_NEAR(p->residual_sd_m, s, 1e-16);
  ASSERT_EQ(p->harmonics.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto c = static_cast<Eigen::Index>(2 * k + 1);
    EXPECT_NEAR(p->harmonics[k].cosine_m, x[c], 1e-16);
    EXPECT_NEAR(p->harmonics[k].sine_m, x[c + 1], 1e-16);
    EXPECT_NEAR(p->harmonics[k].u_m, s * std::sqrt(std::max(inverse(c, c), inverse(c + 1, c + 1))),
                1e-16);
  }
  EXPECT_NEAR(p->EA0C_rad, x[2] / 0.07, 1e-15);
  EXPECT_NEAR(p->EB0C_rad, -x[1] / 0.07, 1e-15);
  // tilt_known is true only if both tilts are given.
  r.tilt_a_rad.assign(25, 0.0);
  EXPECT_FALSE(perpendicularity(r, highest)->tilt_known);
  r.tilt_b_rad.assign(25, 0.0);
  EXPECT_TRUE(perpendicularity(r, highest)->tilt_known);
  r.tilt_a_rad.clear();
  EXPECT_FALSE(perpendicularity(r, highest)->tilt_known);
  EXPECT_FALSE(perpendicularity(r, highest)->axes_known);
}

// Fourteen readings at seven angles determine only as many harmonics as seven readings.
TEST(PerpendicularityEdges, SevenAnglesDoNotShowFiveHarmonics) {
  CircleReadings r;
  r.radius_m = 99.5;
  for (int i = 0; i < 14; ++i) {
    r.angle_rad.push_back(2 * std::numbers::pi * (i % 7) / 7);
    r.height_m.push_back(i % 3 == 0 ? 1e-6 : 0);
  }
  const auto five = perpendicularity(r, 5);
  ASSERT_FALSE(five);
  EXPECT_NE(five.error().message.find("give fewer"), std::string::npos);
  EXPECT_TRUE(perpendicularity(r, 3));
}

// The arms reach a quarter turn, but not more.
TEST(TiltDriveEdges, ArmsReachAQuarterOfATurn) {
  const CoPlanarDrive drive{0.45, 17e-3};
  PlatformMotion platform{};
  platform[kPlatformB].position = std::numbers::pi / 2 - 1e-6;
  EXPECT_TRUE(screws_for(drive, platform));
  platform[kPlatformB].position = -std::numbers::pi / 2 - 1e-9;
  EXPECT_FALSE(screws_for(drive, platform));
  ScrewMotion screws{};
  const double whole_m = 2 * drive.arm_m / platform_ratio(drive);
  screws[kScrewC].position = -whole_m * (1 - 1e-9);
  EXPECT_TRUE(platform_for(drive, screws));
  screws[kScrewC].position = -whole_m * (1 + 1e-9);
  EXPECT_FALSE(platform_for(drive, screws));
  // From 30 degrees a travel of half the arm turns the platform by 60 degrees, to 90 degrees.
  const double step_m = 0.5 * drive.arm_m / platform_ratio(drive);
  const auto reached = rotation_step(drive, std::numbers::pi / 6, step_m * (1 - 1e-9));
  ASSERT_TRUE(reached);
  EXPECT_NEAR(*reached, std::numbers::pi / 3, 1e-4);
  EXPECT_FALSE(rotation_step(drive, std::numbers::pi / 6, step_m * (1 + 1e-9)));
}

// If the platform is at rest, the screws must be at rest, and vice versa.
TEST(TiltDriveEdges, PlatformAndScrewsRestTogether) {
  const CoPlanarDrive drive{0.45, 17e-3};
  PlatformMotion platform{};
  platform[kPlatformX].position = 3e-3;
  platform[kPlatformB].position = 0.2;
  const auto screws = screws_for(drive, platform);
  ASSERT_TRUE(screws);
  const auto back = platform_for(drive, *screws);
  for (std::size_t k = 0; k < 4; ++k)
    for (const Motion& motion : {(*screws)[k], (*back)[k]}) {
      EXPECT_EQ(motion.velocity, 0);
      EXPECT_EQ(motion.acceleration, 0);
    }
}

TEST(PerpendicularityEdges, NeedsARadius) {
  CircleReadings r;
  for (int i = 0; i < 14; ++i) {
    r.angle_rad.push_back(2 * std::numbers::pi * i / 14);
    r.height_m.push_back(0);
  }
  EXPECT_FALSE(perpendicularity(r, 2));
  r.radius_m = 0.1;
  EXPECT_TRUE(perpendicularity(r, 2));
}

}  // namespace
}  // namespace mdof::algo
