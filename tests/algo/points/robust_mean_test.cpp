// The robust mean is compared with a simple calculation by sorting. Mutation tests (tests/mutate)
// found these cases.
#include "algo/points/robust_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mdof::algo {
namespace {

double middle_of(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

struct Plain {
  double mean = 0, sd = 0;
  std::size_t used = 0;
};

// Mean of the readings (up to 512) within eight standard deviations. The standard deviation is
// 1.4826 times the mean of the median absolute deviation and the next larger deviation.
Plain plain_mean(const std::vector<double>& x) {
  const double centre = middle_of(x);
  std::vector<double> off;
  for (const double v : x) off.push_back(std::abs(v - centre));
  const double middle = middle_of(off);
  std::sort(off.begin(), off.end());
  const auto next =
      std::find_if(off.begin(), off.end(), [&](double v) { return v > 1.001 * middle; });
  const double limit = 8 * 1.4826 * (next == off.end() ? middle : (middle + *next) / 2);
  Plain plain;
  double sum = 0, square = 0;
  for (const double v : x) {
    if (std::abs(v - centre) > limit) continue;
    ++plain.used;
    sum += v;
  }
  plain.mean = sum / static_cast<double>(plain.used);
  for (const double v : x)
    if (std::abs(v - centre) <= limit) square += (v - plain.mean) * (v - plain.mean);
  plain.sd = std::sqrt(square / (static_cast<double>(plain.used) - 1));
  return plain;
}

// In a Cauchy distribution several percent of the readings are outliers, and some readings are near
// the limit.
TEST(RobustMeanPlainly, RejectsManyOutliers) {
  std::mt19937_64 engine(5);
  std::cauchy_distribution<> wide(3, 1);
  std::vector<double> scratch;
  std::size_t rejected = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> x(5 + static_cast<std::size_t>(trial) % 508);
    for (double& v : x) v = wide(engine);
    const RobustMean got = robust_mean(x, 1e-9, scratch);
    const Plain plain = plain_mean(x);
    ASSERT_EQ(got.used, plain.used) << x.size();
    ASSERT_EQ(got.rejected, x.size() - plain.used);
    ASSERT_NEAR(got.mean, plain.mean, 1e-12);
    ASSERT_NEAR(got.sd, plain.sd, 1e-12 * plain.sd);
    rejected += got.rejected;
  }
  EXPECT_GT(rejected, 10'000u);
}

// The median and the limit are calculated from every third of 1200 readings, so only readings near
// one of the three levels are used.
TEST(RobustMeanPlainly, UsesEveryThirdOfManyReadings) {
  std::vector<double> x, scratch;
  for (int i = 0; i < 1200; ++i) x.push_back(1000.0 * (i % 3) + i % 7);
  for (const double level : {0.0, 1000.0, 2000.0}) {
    const RobustMean mean = robust_mean(x, 1e-9, scratch);
    EXPECT_EQ(mean.used, 400u);
    EXPECT_NEAR(mean.mean, level + 3, 0.1);
    std::rotate(x.begin(), x.begin() + 1, x.end());
  }
}

// Most readings are equal. A single reading is rejected if it deviates by more than `coarse`. If
// several readings deviate by the same amount, this amount is taken as the step of the reading, and
// readings within 3.5 steps are used.
TEST(RobustMeanPlainly, AcceptsStepsOfTheReading) {
  std::vector<double> x(100, 5.0), scratch;
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 100u);
  EXPECT_EQ(robust_mean(x, 0.5, scratch).mean, 5);
  EXPECT_EQ(robust_mean(x, 0.5, scratch).sd, 0);
  x[7] = 5.4;
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 100u);
  x[7] = 5.6;
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 99u);
  x[30] = 4.4;  // two steps of 0.6 with opposite signs
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 100u);
  x[31] = 5 + 3.4 * 0.6;
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 100u);
  x[31] = 5 + 3.6 * 0.6;
  EXPECT_EQ(robust_mean(x, 0.5, scratch).used, 99u);
}

TEST(RobustMeanPlainly, IsCorrectForTwoReadings) {
  std::vector<double> scratch;
  const RobustMean two = robust_mean(std::vector<double>{1, 3}, 1, scratch);
  EXPECT_EQ(two.used, 2u);
  EXPECT_EQ(two.mean, 2);
  EXPECT_NEAR(two.sd, std::sqrt(2), 1e-15);
  EXPECT_NEAR(two.u, 1, 1e-15);
}

TEST(RobustMeanPlainly, IsCorrectForNoneAndOneReading) {
  std::vector<double> scratch;
  EXPECT_EQ(robust_mean({}, 1, scratch).used, 0u);
  const RobustMean one = robust_mean(std::vector<double>{7}, 1, scratch);
  EXPECT_EQ(one.used, 1u);
  EXPECT_EQ(one.mean, 7);
  EXPECT_EQ(one.sd, 0);
  EXPECT_EQ(one.u, 0);
}

}  // namespace
}  // namespace mdof::algo
