#include "algo/on_the_fly/reading_lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

constexpr double kSpeed_m_s = 0.02, kLate_s = 1e-3;

// Two passes over 41 targets. The readings are delayed by kLate_s. The two directions of the axis
// differ by a constant and a linear function. `alike`: correlation of the noise of neighbouring
// targets.
std::vector<PassBins> late_passes(std::mt19937_64& engine, double noise_m, double alike) {
  std::normal_distribution<> normal;
  std::vector<PassBins> passes(2);
  for (PassBins& pass : passes) {
    pass.direction = &pass == passes.data() ? 1 : -1;
    double noise = normal(engine);
    for (int i = 0; i <= 40; ++i) {
      BinPoint& bin = pass.bins.emplace_back();
      const double x = 1e-3 * i, turn = 2 * M_PI / 8e-3;
      bin.place = i;
      bin.point.position_m = x;
      bin.speed_m_s = kSpeed_m_s;
      bin.slope = {2e-6 * turn * std::cos(turn * x)};
      bin.point.probe_m = {2e-6 * std::sin(turn * x) + noise_m * noise +
                           pass.direction *
                               (30e-9 + 1e-6 * x - kLate_s * kSpeed_m_s * bin.slope[0])};
      noise = alike * noise + std::sqrt(1 - alike * alike) * normal(engine);
    }
  }
  return passes;
}

TEST(ReadingLag, DelayIsFoundAndUMatchesItsScatter) {
  for (const double alike : {0.0, 0.5}) {
    std::mt19937_64 engine(3);
    double mean = 0, square = 0, stated = 0;
    constexpr int kLogs = 400;
    for (int i = 0; i < kLogs; ++i) {
      const ReadingLag lag = reading_lags(late_passes(engine, 1e-9, alike), 1).at(0);
      mean += lag.delay_s / kLogs;
      square += (lag.delay_s - kLate_s) * (lag.delay_s - kLate_s) / kLogs;
      stated += lag.u_delay_s * lag.u_delay_s / kLogs;
      EXPECT_TRUE(lag.significant);
    }
    EXPECT_NEAR(mean, kLate_s, 0.2 * std::sqrt(square));
    EXPECT_NEAR(std::sqrt(stated / square), 1, alike > 0 ? 0.35 : 0.12) << alike;
  }
}

TEST(ReadingLag, MatchesManualCalculationWithoutNoise) {
  std::mt19937_64 engine(1);
  const ReadingLag lag = reading_lags(late_passes(engine, 0, 0), 1).at(0);
  EXPECT_NEAR(lag.delay_s, kLate_s, 1e-12);
  EXPECT_NEAR(lag.speed_m_s, kSpeed_m_s, 1e-15);
  EXPECT_NEAR(lag.largest_slope_1, 2e-6 * 2 * M_PI / 8e-3, 1e-12);
  EXPECT_NEAR(lag.effect_m, kLate_s * kSpeed_m_s * lag.largest_slope_1, 1e-15);
  EXPECT_TRUE(lag.significant);
}

// Expected: the normal equations of three unknowns (constant, line and delay). The residuals of
// neighbouring targets are correlated.
TEST(ReadingLag, UIsWidenedForCorrelatedNeighbours) {
  std::mt19937_64 engine(9);
  const std::vector<PassBins> passes = late_passes(engine, 2e-9, 0.7);
  const ReadingLag found = reading_lags(passes, 1).at(0);
  std::vector<double> y, x, f;
  for (std::size_t i = 0; i <= 40; ++i) {
    const BinPoint &out = passes[0].bins[i], &back = passes[1].bins[i];
    y.push_back(out.point.probe_m[0] - back.point.probe_m[0]);
    x.push_back(out.point.position_m - 0.02);
    f.push_back(-2 * kSpeed_m_s * out.slope[0]);
  }
  // The constant and the line are orthogonal over these positions.
  const auto without_line = [&](std::vector<double> v) {
    double mean = 0, xv = 0, xx = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      mean += v[i] / 41, xv += x[i] * v[i], xx += x[i] * x[i];
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= mean + xv / xx * x[i];
    return v;
  };
  y = without_line(y);
  f = without_line(f);
  double fy = 0, ff = 0, square = 0, product = 0;
  for (std::size_t i = 0; i < 41; ++i) fy += f[i] * y[i], ff += f[i] * f[i];
  for (std::size_t i = 0; i < 41; ++i) y[i] -= fy / ff * f[i];
  for (std::size_t i = 0; i < 41; ++i)
    square += y[i] * y[i], product += i > 0 ? y[i] * y[i - 1] : 0;
  const double alike = product / square;
  EXPECT_GT(alike, 0.2);
  EXPECT_NEAR(found.delay_s, fy / ff, 1e-9);
  EXPECT_NEAR(found.u_delay_s, std::sqrt(square / 38 / ff * (1 + alike) / (1 - alike)), 1e-9);
}

// Eleven targets in both directions are too few. A target with a reading in one direction only is
// ignored. Without passes there is no speed.
TEST(ReadingLag, NeedsTwelveTargetsInBothDirections) {
  std::mt19937_64 engine(2);
  std::vector<PassBins> passes = late_passes(engine, 1e-9, 0);
  for (PassBins& pass : passes) pass.bins.resize(13);
  passes[0].bins[4].point.probe_m[0] = std::nan("");
  ReadingLag lag = reading_lags(passes, 1).at(0);
  EXPECT_NEAR(lag.delay_s, kLate_s, 1e-3 * kLate_s + 5 * lag.u_delay_s);
  EXPECT_GT(lag.u_delay_s, 0);
  passes[1].bins[7].point.probe_m[0] = std::nan("");
  lag = reading_lags(passes, 1).at(0);
  EXPECT_TRUE(std::isnan(lag.delay_s));
  EXPECT_TRUE(std::isnan(lag.u_delay_s));
  EXPECT_FALSE(lag.significant);
  EXPECT_EQ(lag.effect_m, 0);
  EXPECT_NEAR(lag.speed_m_s, kSpeed_m_s, 1e-15);
  const ReadingLag none = reading_lags({}, 2).at(1);
  EXPECT_TRUE(std::isnan(none.delay_s) && std::isnan(none.speed_m_s));
  EXPECT_EQ(none.largest_slope_1, 0);
}

// If the readings rise linearly, the delay cannot be determined: its effect equals a difference of
// the axis between the directions.
TEST(ReadingLag, IsUnknownForAConstantSlope) {
  std::mt19937_64 engine(2);
  std::vector<PassBins> passes = late_passes(engine, 1e-9, 0);
  for (PassBins& pass : passes)
    for (BinPoint& bin : pass.bins) bin.slope = {1e-3};
  EXPECT_TRUE(std::isnan(reading_lags(passes, 1).at(0).delay_s));
}

// For each target and direction the mean of the readings and the mean speed are used.
TEST(ReadingLag, UsesTheMeanOfSeveralPasses) {
  std::mt19937_64 engine(2);
  std::vector<PassBins> passes = late_passes(engine, 0, 0);
  passes.push_back(passes[0]);
  passes.push_back(passes[0]);
  for (std::size_t i = 0; i <= 40; ++i) {
    BinPoint &fast = passes[2].bins[i], &slow = passes[3].bins[i];
    // One pass is faster by 20 mm/s, another slower by 10 mm/s. The readings are shifted in
    // proportion.
    fast.speed_m_s = 0.04;
    fast.point.probe_m[0] -= kLate_s * 0.02 * fast.slope[0];
    slow.speed_m_s = 0.01;
    slow.point.probe_m[0] += kLate_s * 0.01 * slow.slope[0];
  }
  const ReadingLag lag = reading_lags(passes, 1).at(0);
  EXPECT_NEAR(lag.delay_s, kLate_s, 1e-12);
  EXPECT_NEAR(lag.speed_m_s, (0.02 + 0.02 + 0.04 + 0.01) / 4, 1e-15);
}

// If the readings are equal in both directions, the delay is 0 with the uncertainty 0.
TEST(ReadingLag, IsZeroWithoutDifference) {
  std::mt19937_64 engine(1);
  auto passes = late_passes(engine, 0, 0);
  for (PassBins& pass : passes)
    for (BinPoint& bin : pass.bins) bin.point.probe_m = {1e-6};
  const ReadingLag lag = reading_lags(passes, 1).at(0);
  EXPECT_EQ(lag.delay_s, 0);
  EXPECT_EQ(lag.u_delay_s, 0);
  EXPECT_EQ(lag.effect_m, 0);
  EXPECT_FALSE(lag.significant);
}

}  // namespace
}  // namespace mdof::algo
