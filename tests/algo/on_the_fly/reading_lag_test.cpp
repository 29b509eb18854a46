#include "algo/on_the_fly/reading_lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

constexpr double kSpeed_m_s = 0.02, kLate_s = 1e-3;

// Two passes over 41 targets, readings late by kLate_s, an axis that differs by its direction by a
// constant and a line. `alike`: correlation of the noise of neighbours.
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

TEST(ReadingLag, IsFoundAndItsUncertaintyIsItsScatter) {
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

TEST(ReadingLag, WithoutNoiseByHand) {
  std::mt19937_64 engine(1);
  const ReadingLag lag = reading_lags(late_passes(engine, 0, 0), 1).at(0);
  EXPECT_NEAR(lag.delay_s, kLate_s, 1e-12);
  EXPECT_NEAR(lag.speed_m_s, kSpeed_m_s, 1e-15);
  EXPECT_NEAR(lag.steepest_1, 2e-6 * 2 * M_PI / 8e-3, 1e-12);
  EXPECT_NEAR(lag.effect_m, kLate_s * kSpeed_m_s * lag.steepest_1, 1e-15);
  EXPECT_TRUE(lag.significant);
}

}  // namespace
}  // namespace mdof::algo
