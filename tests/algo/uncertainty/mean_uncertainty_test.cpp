// The uncertainty of a mean, compared with sums of products that are calculated by hand. Mutation
// tests (tests/mutate) found these cases.
#include "algo/uncertainty/mean_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/algo/no_pattern.h"

namespace mdof::algo {
namespace {

// A series of `runs` blocks; each has `length` readings of +1 or -1, in turn. The mean is 0, the
// standard deviation √(n/(n - 1)).
double alternating_run_u(int length, int runs) {
  std::vector<double> x;
  for (int k = 0; k < runs; ++k)
    x.insert(x.end(), static_cast<std::size_t>(length), k % 2 ? -1 : 1);
  const auto n = static_cast<double>(x.size());
  return mean_uncertainty(x, std::sqrt(n / (n - 1)));
}

// Four blocks of four readings, 16 in all. Correlations:
// lag 1: 3 of 15 products are negative: 9/16
// lag 2: 6 of 14 products are negative: 2/16
// lag 3: 9 of 13 products are negative: -5/16
// The first pair, 1 and 9/16, has the sum 25/16 and is used; the next pair is not.
// u² = (2 × 25/16 - 1) / (16 - 3).
TEST(MeanUncertainty, UsesOnePairOfLags) {
  EXPECT_NEAR(alternating_run_u(4, 4), std::sqrt((50 / 16.0 - 1) / 13), 1e-14);
}

// Four blocks of eight readings, 32 in all. The pairs of correlations are 1, 25/32 | 18/32, 11/32 |
// 4/32, -3/32. The sum of the last pair is below the noise limit √(2/32).
TEST(MeanUncertainty, UsesTwoPairsOfLags) {
  EXPECT_NEAR(alternating_run_u(8, 4), std::sqrt((2 * 86 / 32.0 - 1) / 25), 1e-14);
}

// If single readings alternate, the sum of the pairs is below the variance of one reading. u is
// then the u of independent readings.
TEST(MeanUncertainty, IsAtLeastThatOfIndependentReadings) {
  EXPECT_NEAR(alternating_run_u(1, 16), 1 / std::sqrt(15), 1e-14);
}

TEST(MeanUncertainty, IsCorrectForFewReadings) {
  EXPECT_EQ(mean_uncertainty({}, 0), 0);
  EXPECT_EQ(mean_uncertainty(std::vector<double>{0}, 3), 0);
  EXPECT_NEAR(mean_uncertainty(std::vector<double>{1, -1}, std::sqrt(2)), 1, 1e-14);
}

// More than 256 readings are replaced by means of equal numbers of readings. Each four of 1024
// readings are replaced by their mean, so a block of sixteen becomes a block of four.
TEST(MeanUncertainty, AveragesManyReadings) {
  const double few = alternating_run_u(4, 64), many = alternating_run_u(16, 64);
  EXPECT_NEAR(many, few, 1e-12);
}

// Applies the rule of mean_uncertainty.h to correlated series by plain loops.
double by_plain_loops(const std::vector<double>& x, double sd) {
  const std::size_t n = x.size();
  const auto covariance = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < n; ++i) sum += x[i] * x[i - lag];
    return sum / static_cast<double>(n);
  };
  const double variance = covariance(0), noise = variance * std::sqrt(2.0 / double(n));
  double pairs = 0, least = HUGE_VAL;
  std::size_t window = 0;
  for (std::size_t lag = 0; window < n / 4; lag += 2) {
    const double pair = std::min(least, covariance(lag) + covariance(lag + 1));
    if (lag > 0 && pair < noise) break;
    pairs += pair;
    least = pair;
    window = lag + 1;
  }
  const double sum = 2 * pairs - variance;
  const double of_mean =
      sum < variance ? variance / double(n - 1) : sum / (double(n) - double(2 * window + 1));
  return std::sqrt(std::max(of_mean, sd * sd / double(n)));
}

TEST(MeanUncertainty, MatchesPlainLoops) {
  for (const double alike : {0.0, 0.5, 0.9, 0.99})
    for (const std::size_t n : {4u, 5u, 8u, 9u, 16u, 37u, 100u, 255u, 256u}) {
      std::vector<double> x;
      double state = 0, mean = 0, square = 0;
      test::NoPattern numbers(n);
      for (std::size_t i = 0; i < n; ++i) {
        state = alike * state + numbers.between(-1, 1);
        x.push_back(state);
        mean += state / static_cast<double>(n);
      }
      for (double& v : x) {
        v -= mean;
        square += v * v;
      }
      const double sd = std::sqrt(square / static_cast<double>(n - 1));
      EXPECT_NEAR(mean_uncertainty(x, sd), by_plain_loops(x, sd), 1e-13) << alike << " " << n;
    }
}

}  // namespace
}  // namespace mdof::algo
