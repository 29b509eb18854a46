#include "algo/drift/warm_up.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kPerHour = 1e-9 / 3600;  // 1 nm/h

ParkedReadings readings(std::size_t steps, double step_s, double limit_nm_per_h,
                        const std::function<double(double)>& at_nm) {
  ParkedReadings r;
  r.step_s = step_s;
  r.series.push_back({"A_um", {}, limit_nm_per_h * kPerHour});
  for (std::size_t i = 0; i < steps; ++i)
    r.series[0].value.push_back(at_nm(static_cast<double>(i) * step_s) * 1e-9);
  return r;
}

// A small variation without drift.
double steady(double s) {
  return 0.01 * std::sin(1.3 * s);
}

// The drift is 2 µm in total with a time constant of 20 min. Its rate is 6000 exp(-t / 20 min) nm/h
// and falls below 100 nm/h after 20 min · ln 60 = 81.9 min. The window of 5 min from 80 min has a
// mean rate of 98 ± 1 nm/h, which is within two u of the limit. The window from 85 min has a mean
// rate of 76 nm/h.
TEST(WarmUp, ExponentialIsReadyBelowTheLimit) {
  const auto r = readings(4 * 120, 30, 100, [](double s) { return -2000 * std::exp(-s / 1200); });
  const WarmUp w = warm_up(r);
  ASSERT_EQ(w.begin_s.size(), 48u);
  EXPECT_DOUBLE_EQ(w.window_s, 300);
  ASSERT_TRUE(w.ready_after_s);
  EXPECT_DOUBLE_EQ(*w.ready_after_s, 85 * 60);
  EXPECT_NEAR(w.windows[0][16].rate_per_s / kPerHour, 98, 1);
  EXPECT_EQ(w.windows[0][0].verdict, DriftVerdict::above);
  EXPECT_NEAR(w.windows[0][0].rate_per_s / kPerHour, 6000 * std::exp(-135.0 / 1200), 60);
}

TEST(WarmUp, ShortLogsAreNotReady) {
  EXPECT_FALSE(warm_up(readings(30 * 10, 30, 100, [](double s) {
                 return -2000 * std::exp(-s / 1200) + (s > 8000 ? 1 : 0) * (s - 8000);
               })).ready_after_s);
  EXPECT_FALSE(warm_up(readings(29, 30, 100, steady)).ready_after_s);
  EXPECT_TRUE(warm_up(readings(30, 30, 100, steady)).ready_after_s);
  EXPECT_FALSE(warm_up(readings(0, 30, 100, steady)).ready_after_s);
  const auto infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(warm_up(readings(60, 30, infinity, steady)).ready_after_s);
}

TEST(WarmUp, LogsShorterThanTenMinutesAreNotReady) {
  EXPECT_FALSE(warm_up(readings(40, 0.1, 1e6, steady)).ready_after_s);
  EXPECT_FALSE(warm_up(readings(59, 10, 1e4, steady)).ready_after_s);
  EXPECT_TRUE(warm_up(readings(60, 10, 1e4, steady)).ready_after_s);
}

// A probe that does not work has a constant reading and the smallest drift. It must not be ready.
TEST(WarmUp, DriftOfAConstantReadingIsUnknown) {
  const WarmUp w = warm_up(readings(60, 30, 100, [](double) { return 1.5; }));
  EXPECT_EQ(w.windows[0][0].verdict, DriftVerdict::unknown);
  EXPECT_FALSE(w.ready_after_s);
}

// Calculated by hand: the last of ten readings is 1 nm, the others are 0. The slope is 4.5 / 82.5
// per step; the sum of the squared residuals is 0.9 - 4.5²/82.5, divided by 8 and by 82.5.
TEST(WarmUp, RateAndItsUncertaintyByHand) {
  const auto r = readings(10, 1, 1e6, [](double s) { return s == 9 ? 1.0 : 0.0; });
  const DriftWindow w = warm_up(r).windows[0][0];
  EXPECT_NEAR(w.rate_per_s, 4.5 / 82.5 * 1e-9, 1e-18);
  EXPECT_NEAR(w.u_rate_per_s, std::sqrt((0.9 - 4.5 * 4.5 / 82.5) / 8 / 82.5) * 1e-9, 1e-18);
}

TEST(WarmUp, NoiseGivesAnUndecidedVerdict) {
  const auto r = readings(60, 1, 100, [](double s) { return std::fmod(s * 7, 10); });
  const WarmUp w = warm_up(r);
  EXPECT_FALSE(w.ready_after_s);
  EXPECT_EQ(w.windows[0][0].verdict, DriftVerdict::undecided);
}

TEST(WarmUp, DriftOfAWindowWithFewReadingsIsUnknown) {
  auto r = readings(40, 30, 100, steady);
  for (std::size_t i = 0; i < 4; ++i) r.series[0].value[i] = std::nan("");
  EXPECT_EQ(warm_up(r).windows[0][0].verdict, DriftVerdict::below);
  r.series[0].value[4] = std::nan("");
  const WarmUp w = warm_up(r);
  EXPECT_EQ(w.windows[0][0].verdict, DriftVerdict::unknown);
  EXPECT_TRUE(std::isnan(w.windows[0][0].rate_per_s));
  ASSERT_TRUE(w.ready_after_s);
  EXPECT_DOUBLE_EQ(*w.ready_after_s, 300);
}

TEST(WarmUp, FindsTheSlopeOverTemperature) {
  auto r = readings(40, 30, 100, [](double s) { return -30 * std::sin(s / 200); });
  for (std::size_t i = 0; i < 40; ++i)
    r.temperature_C.push_back(20 + std::sin(static_cast<double>(i) * 30 / 200));
  WarmUp w = warm_up(r);
  EXPECT_NEAR(w.with_temperature[0].slope_per_K, -30e-9, 1e-15);
  EXPECT_NEAR(w.with_temperature[0].correlation, -1, 1e-12);
  r.temperature_C.assign(40, 20);
  w = warm_up(r);
  EXPECT_TRUE(std::isnan(w.with_temperature[0].correlation));
}

TEST(WarmUp, MissingTemperatureExcludesItsReading) {
  auto r = readings(40, 30, 100, [](double s) { return -30 * std::sin(s / 200); });
  for (std::size_t i = 0; i < 40; ++i)
    r.temperature_C.push_back(20 + std::sin(static_cast<double>(i) * 30 / 200));
  for (const std::size_t i : {0U, 7U, 39U}) {
    r.temperature_C[i] = std::nan("");
    r.series[0].value[i] += 1e-3;  // the temperature of this reading is unknown
  }
  const WarmUp w = warm_up(r);
  EXPECT_NEAR(w.with_temperature[0].slope_per_K, -30e-9, 1e-15);
  EXPECT_NEAR(w.with_temperature[0].correlation, -1, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
