// Tests the noise floor, which is the lower quartile of the noise of the slots. The slots are given
// one by one. Mutation tests (tests/mutate) found these cases.
#include "algo/plausibility/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kRowsOfSlot = 16;

// Mean |second difference| of white noise with this standard deviation. It is reduced, because the
// lower quartile of slots with 16 rows is below their mean.
double mean_second_difference(double sd) {
  return std::sqrt(6) * std::sqrt(2 / std::numbers::pi) * sd * (1 - 0.72 / 4);
}

double noise_floor_for(const std::vector<double>& sds) {
  NoiseFloor floor;
  for (const double sd : sds) floor.add(mean_second_difference(sd), kRowsOfSlot);
  return floor.sd();
}

// Centres of the bins of the standard deviation: 17/32, 19/32 ... 31/32, eight per octave.
double middle(int eighth, int exponent) {
  return std::ldexp((17 + 2 * eighth) / 32.0, exponent);
}

TEST(NoiseFloorRule, NoiseOfASlotIsTheCentreOfItsBin) {
  for (const int exponent : {-49, -48, -30, -20, 0, 10}) {
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double sd = middle(eighth, exponent);
      EXPECT_NEAR(noise_floor_for({sd}) / sd, 1, 1e-12) << eighth << " " << exponent;
      EXPECT_NEAR(noise_floor_for({sd * (1 + 0.9 / (17 + 2 * eighth))}) / sd, 1, 1e-12);
      EXPECT_NEAR(noise_floor_for({sd * (1 - 0.9 / (17 + 2 * eighth))}) / sd, 1, 1e-12);
    }
  }
}

TEST(NoiseFloorRule, IsTheLowerQuartileInAnyOrder) {
  const double a = middle(0, -20), b = middle(3, -20), c = middle(7, -20), d = middle(2, -18);
  EXPECT_NEAR(noise_floor_for({a, b, c, d}), a, 1e-15 * a);
  EXPECT_NEAR(noise_floor_for({d, c, b, a}), a, 1e-15 * a);
  EXPECT_NEAR(noise_floor_for({d, c, b, a, d}), b, 1e-12 * b);
  EXPECT_NEAR(noise_floor_for({a, d, b, c, d}), b, 1e-12 * b);
  EXPECT_NEAR(noise_floor_for({d, d, d, d, d, d, a, b, c}), c, 1e-12 * c);
  EXPECT_NEAR(noise_floor_for({d, d, d, d, d, d, a, b}), b, 1e-12 * b);
  EXPECT_NEAR(noise_floor_for({c, a, a, a, c, c, c, c, c, c, c, c, c}), c, 1e-12 * c);
  EXPECT_NEAR(noise_floor_for({c, a, a, a, c, c, c, c, c, c, c, c}), a, 1e-12 * a);
}

TEST(NoiseFloorRule, IsZeroWithoutNoiseAndIgnoresMissingSlots) {
  EXPECT_EQ(NoiseFloor().sd(), 0);
  EXPECT_EQ(noise_floor_for({0}), 0);
  EXPECT_EQ(noise_floor_for({middle(4, -51)}), 0);  // below 1e-15 m
  NoiseFloor floor;
  floor.add(mean_second_difference(middle(5, -20)), kRowsOfSlot);
  for (int i = 0; i < 10; ++i) floor.add(kNaN, kRowsOfSlot), floor.add(0, 0);
  EXPECT_NEAR(floor.sd() / middle(5, -20), 1, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
