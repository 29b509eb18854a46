// U of E and B of imported readings. The intervals of simulated axes must contain the true values.
#include "algo/uncertainty/positioning/range_of_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

struct ReadAxis {
  int targets = 11, runs = 5;
  double form = 0, reversal = 0;  // in units of the scatter of a reading
  double u_target = 0;
};

double true_error(const ReadAxis& axis, int target, int direction) {
  return axis.form * std::sin(0.6 * target) + direction * axis.reversal / 2;
}

// Share of the logs whose E and B, with U, contain the true values.
struct HeldShare {
  double E = 0, B = 0;
};

HeldShare share_held(const ReadAxis& axis) {
  std::mt19937_64 random(test::coverage_seed(11));
  std::normal_distribution<double> normal;
  double true_high = -1e9, true_low = 1e9;
  for (int target = 0; target < axis.targets; ++target)
    for (const int direction : {1, -1}) {
      true_high = std::max(true_high, true_error(axis, target, direction));
      true_low = std::min(true_low, true_error(axis, target, direction));
    }
  const int logs = test::coverage_runs(100);
  HeldShare found;
  for (int log = 0; log < logs; ++log) {
    std::vector<MeanOfReadings> ways[2];
    for (int target = 0; target < axis.targets; ++target) {
      const double of_target = axis.u_target * normal(random);
      for (const int way : {0, 1}) {
        std::vector<double> readings;
        for (int run = 0; run < axis.runs; ++run)
          readings.push_back(true_error(axis, target, way == 0 ? 1 : -1) + of_target +
                             normal(random));
        MeanOfReadings mean{target, 0, readings.size(), 0};
        for (const double r : readings) mean.value += r / axis.runs;
        for (const double r : readings) mean.squares += (r - mean.value) * (r - mean.value);
        ways[way].push_back(mean);
      }
    }
    std::vector<MeanOfReadings> both = ways[0];
    both.insert(both.end(), ways[1].begin(), ways[1].end());
    const auto [low, high] = std::minmax_element(
        both.begin(), both.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    double B = 0;
    for (std::size_t i = 0; i < ways[0].size(); ++i)
      B = std::max(B, std::abs(ways[0][i].value - ways[1][i].value));
    const double E = high->value - low->value;
    found.E += std::abs(E - (true_high - true_low)) <= range_trials(both, axis.u_target).U();
    found.B += std::abs(B - axis.reversal) <= reversal_trials(ways[0], ways[1]).U();
  }
  return {found.E / logs, found.B / logs};
}

// u of the two extreme means alone gives 31 % for E of a flat axis.
TEST(RangeOfMeans, IntervalsContainTheTrueValues) {
  for (const ReadAxis& axis :
       {ReadAxis{}, ReadAxis{11, 2}, ReadAxis{21, 5}, ReadAxis{11, 5, 0.5}, ReadAxis{11, 5, 2, 1},
        ReadAxis{11, 5, 10, 3}, ReadAxis{11, 3, 0, 0, 1}, ReadAxis{11, 5, 10, 3, 1}}) {
    const HeldShare found = share_held(axis);
    const auto name = testing::Message() << axis.targets << " targets, " << axis.runs << " runs, "
                                         << axis.form << ", " << axis.reversal;
    EXPECT_GE(found.E, 0.9) << name;
    EXPECT_GE(found.B, 0.9) << name;
    if (axis.form < 5) continue;  // small ranges: U includes the bias by noise
    EXPECT_LE(found.E, 0.995) << name;
  }
}

// The readings of a target with both approaches share one error, so it changes no reversal.
TEST(RangeOfMeans, ATargetsErrorChangesTheRangeOnly) {
  const std::vector<MeanOfReadings> forward = {{1, 0, 5, 4}, {2, 100, 5, 4}},
                                    reverse = {{1, 3, 5, 4}, {2, 104, 5, 4}};
  std::vector<MeanOfReadings> both = forward;
  both.insert(both.end(), reverse.begin(), reverse.end());
  // The pooled variance is 16 / 16 with 16 degrees of freedom: u of a mean is 1/√5.
  EXPECT_NEAR(range_trials(both, 0).standard_deviation(), std::sqrt(2 / 5.0 * 16 / 14), 0.03);
  EXPECT_NEAR(range_trials(both, 3).standard_deviation(), std::sqrt(18 + 2 / 5.0 * 16 / 14), 0.15);
  EXPECT_GT(range_trials(both, 3).U(), 7.5);
  EXPECT_LT(reversal_trials(forward, reverse).U(), 2.5);
}

}  // namespace
}  // namespace mdof::algo
