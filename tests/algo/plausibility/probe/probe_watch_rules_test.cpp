// Tests the rules of probe_watch.h on both sides of each limit. The scans are given one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algo/plausibility/probe/probe_watch.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr std::int64_t kScan_ns = 1'000'000;

// A ProbeWatch that receives one scan after another. The test itself defines the stops.
struct Watched {
  ProbeWatch watch;
  std::vector<double> reading_m;
  std::int64_t t_ns = 500'000'000;

  explicit Watched(std::size_t probes) : watch(probes), reading_m(probes, 0) {}
  void scan(double axis_m) {
    FrameBlock frames;
    frames.time_ns = {t_ns};
    frames.encoder_m = {axis_m};
    for (const double x : reading_m) frames.probe_m.push_back({x});
    frames.probe_quality.resize(reading_m.size());
    watch.take_newest(frames, 0, 1, axis_m, axis_m);
    t_ns += kScan_ns;
  }
  void stops(std::size_t probe, int n, double sd_m, double resolution_m = 0) {
    RobustMean mean;
    mean.sd = sd_m;
    for (int i = 0; i < n; ++i) watch.take_stop(probe, mean, resolution_m);
  }
};

// Each of ten readings is repeated for `each` scans, then one reading for `held` scans. Returns
// whether the probe is reported as frozen.
bool frozen_by_noise(int each, int held, int stops, double sd_m, double resolution_m) {
  Watched w(1);
  for (int value = 0; value < 10; ++value) {
    w.reading_m[0] = 1e-6 * value;
    for (int i = 0; i < each; ++i) w.scan(0);
  }
  w.stops(0, stops, sd_m, resolution_m);
  w.reading_m[0] = -1e-6;
  for (int i = 0; i < held; ++i) w.scan(0);
  return !w.watch.frozen().empty();
}

TEST(ProbeWatchRule, FrozenIsEightTimesTheLongestSpanAnd128Scans) {
  EXPECT_FALSE(frozen_by_noise(20, 159, 3, 2e-9, 1e-9));
  EXPECT_TRUE(frozen_by_noise(20, 160, 3, 2e-9, 1e-9));
  EXPECT_FALSE(frozen_by_noise(1, 127, 3, 2e-9, 1e-9));
  EXPECT_TRUE(frozen_by_noise(1, 128, 3, 2e-9, 1e-9));
  EXPECT_FALSE(frozen_by_noise(1, 128, 2, 2e-9, 1e-9));  // at least three stops are required
  EXPECT_FALSE(frozen_by_noise(1, 128, 3, 1e-9, 1e-9));  // the noise is not above the resolution
  EXPECT_FALSE(frozen_by_noise(1, 128, 3, 1e-12, 0));    // rounding of the arithmetic only
}

TEST(ProbeWatchRule, OneStopWithoutNoisePreventsDetection) {
  Watched w(1);
  w.stops(0, 2, 2e-9);
  w.stops(0, 1, 0);
  w.stops(0, 5, 2e-9);
  for (int i = 0; i < 1000; ++i) {
    if (i < 50) w.reading_m[0] = 1e-6 * i;
    w.scan(0);
  }
  EXPECT_TRUE(w.watch.frozen().empty());
}

// The span of a constant reading lasts from its first scan to the first scan with another reading.
// Each span is reported separately.
TEST(ProbeWatchRule, EachSpanHasItsTimesAndReading) {
  Watched w(2);
  w.stops(1, 3, 2e-9);
  int n = 0;
  const auto live = [&](int scans) {
    for (int i = 0; i < scans; ++i) w.reading_m[1] = 1e-9 * ++n, w.scan(0);
  };
  std::vector<std::int64_t> since_ns, until_ns;
  live(50);
  for (int span = 0; span < 2; ++span) {
    w.reading_m[1] = 7e-6 + 1e-6 * span;
    since_ns.push_back(w.t_ns);
    for (int i = 0; i < 300; ++i) w.scan(0);
    until_ns.push_back(w.t_ns);
    live(200);  // the probe works again; its spans are normal spans
  }
  const auto frozen = w.watch.frozen();
  ASSERT_EQ(frozen.size(), 2u);
  for (std::size_t span = 0; span < 2; ++span) {
    EXPECT_EQ(frozen[span].probe, 1u);
    EXPECT_EQ(frozen[span].begin_ns, since_ns[span]);
    EXPECT_EQ(frozen[span].end_ns, until_ns[span]);
    EXPECT_EQ(frozen[span].value_m, span ? 8e-6 : 7e-6);
  }
  const Notices found = probe_notices(w.watch, {"A", "B"}, 500'000'000);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(test::shown(found[0]), "probe_frozen B from_s=0.05 to_s=0.35 reading_um=7");
}

// Before and after a constant span, the readings are below it or, with `low`, above it. In between,
// `beyond` readings are on the other side. Returns the notice of the span.
std::string notice_of_span(bool low, int beyond, int scans_after) {
  Watched w(1);
  w.stops(0, 3, 2e-9);
  const auto scan = [&](double reading_m) {
    w.reading_m[0] = low ? -reading_m : reading_m, w.scan(0);
  };
  for (int i = 0; i < 50; ++i) scan(5e-6 + 1e-9 * (i % 7));
  for (int i = 0; i < beyond; ++i) scan(6.1e-6);
  for (int i = 0; i < 300; ++i) scan(6e-6);
  for (int i = 0; i < scans_after; ++i) scan(5e-6 + 1e-9 * (i % 7));
  const Notices found = probe_notices(w.watch, {"A"}, 0);
  EXPECT_EQ(found.size(), 1u);
  return found.empty() ? "" : to_string(found[0].code);
}

TEST(ProbeWatchRule, LargestOrSmallestReadingIsTheLimitOfTheAmplifier) {
  for (const bool low : {false, true}) {
    EXPECT_EQ(notice_of_span(low, 0, 50), "probe_at_limit");
    EXPECT_EQ(notice_of_span(low, 1, 50), "probe_frozen");  // a reading is beyond the span
    EXPECT_EQ(notice_of_span(low, 0, 0), "probe_frozen");   // the reading did not come back
  }
}

struct Travel {
  int changes = 20, rows = 128;
  double travel_m = 10e-3, share = 0.9, range_in_steps = 5;
};

// The readings are constant at stops, so the stops do not show the noise. The reading remains
// constant while the axis moves.
bool frozen_by_travel(const Travel& t) {
  constexpr double kStep_m = 100e-9;
  Watched w(1);
  w.stops(0, 1, 0, kStep_m);
  for (int i = 0; i < t.changes; ++i) {
    w.reading_m[0] = i % 2 ? kStep_m * t.range_in_steps : 0;
    w.scan(i == 0 ? t.travel_m : 0);
  }
  for (int i = 1; i < t.rows; ++i) w.scan(t.share * t.travel_m * i / (t.rows - 1));
  return !w.watch.frozen().empty();
}

TEST(ProbeWatchRule, FrozenOverFourFifthsOfTheTravel) {
  EXPECT_TRUE(frozen_by_travel({}));
  EXPECT_FALSE(frozen_by_travel({.rows = 127}));
  EXPECT_FALSE(frozen_by_travel({.changes = 15}));
  EXPECT_TRUE(frozen_by_travel({.changes = 16}));
  EXPECT_FALSE(frozen_by_travel({.travel_m = 0.99e-3}));
  EXPECT_TRUE(frozen_by_travel({.travel_m = 1.01e-3}));
  EXPECT_FALSE(frozen_by_travel({.share = 0.79}));
  EXPECT_TRUE(frozen_by_travel({.share = 0.81}));
  EXPECT_FALSE(frozen_by_travel({.range_in_steps = 3.9}));
  EXPECT_TRUE(frozen_by_travel({.range_in_steps = 4.1}));
}

// The reading of the last of `probes` probes never changes. `noisy` of the other probes have noise
// at their stops.
bool dead_from_the_start(std::size_t probes, std::size_t noisy, int rows, double travel_m) {
  Watched w(probes);
  for (std::size_t k = 0; k < noisy; ++k) w.stops(k, 3, 2e-9);
  for (int i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k + 1 < probes; ++k) w.reading_m[k] = 1e-9 * (i + 1);
    w.scan(travel_m * i / (rows - 1));
  }
  const auto frozen = w.watch.frozen();
  if (!frozen.empty()) {
    EXPECT_EQ(frozen.size(), 1u);
    EXPECT_EQ(frozen[0].probe, probes - 1);
    EXPECT_EQ(frozen[0].begin_ns, 500'000'000);
  }
  return !frozen.empty();
}

TEST(ProbeWatchRule, DeadFromTheStartIfHalfOfTheOthersWork) {
  EXPECT_TRUE(dead_from_the_start(5, 2, 128, 5e-3));
  EXPECT_FALSE(dead_from_the_start(5, 1, 128, 5e-3));
  EXPECT_TRUE(dead_from_the_start(4, 2, 128, 5e-3));
  EXPECT_FALSE(dead_from_the_start(4, 1, 128, 5e-3));
  EXPECT_FALSE(dead_from_the_start(5, 4, 127, 5e-3));
  EXPECT_FALSE(dead_from_the_start(5, 4, 128, 0.99e-3));
}

// The readings of `alive` of five probes change while the axis moves by travel_m.
bool chain_is_dead(std::size_t alive, double travel_m) {
  Watched w(5);
  for (int i = 0; i < 128; ++i) {
    for (std::size_t k = 0; k < alive; ++k) w.reading_m[k] = 1e-9 * (i + 1);
    w.scan(travel_m * i / 127);
  }
  return w.watch.is_dead();
}

TEST(ProbeWatchRule, ChainWithAtMostOneWorkingProbeIsDead) {
  EXPECT_TRUE(chain_is_dead(0, 5e-3));
  EXPECT_TRUE(chain_is_dead(1, 5e-3));
  EXPECT_FALSE(chain_is_dead(2, 5e-3));
  EXPECT_FALSE(chain_is_dead(0, 0.99e-3));
}

// Number of reported steps of `size_m`. The log contains `seen` such steps, and the readings of the
// stops have the standard deviations `sd_m`.
std::size_t reported_step_count(double size_m, std::size_t seen, const std::vector<double>& sd_m,
                                double resolution_m) {
  FrameBlock frames;
  frames.probe_m.resize(2);
  frames.probe_quality.resize(2);
  for (int i = 0; i < 40; ++i) {
    frames.time_ns.push_back(kScan_ns * i);
    frames.encoder_m.push_back(0);
    frames.probe_m[0].push_back(0);
    frames.probe_m[1].push_back(i < 17 ? 0 : size_m);
  }
  Watched w(2);
  for (const double sd : sd_m) w.stops(1, 1, sd, resolution_m);
  for (std::size_t i = 0; i < seen; ++i) w.watch.look_for_steps({frames, 0, 10, 20, 40});
  const auto steps = w.watch.steps();
  for (const SteppedProbe& s : steps) {
    EXPECT_EQ(s.probe, 1u);
    EXPECT_EQ(s.time_ns, 17 * kScan_ns);
    EXPECT_EQ(s.size_m, size_m);
  }
  return steps.size();
}

TEST(ProbeWatchRule, StepIs12TimesTheNoiseAnd4TimesTheResolution) {
  const std::vector<double> median_2_nm = {9e-9, 1e-9, 2e-9};
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(reported_step_count(sign * 23.9e-9, 1, median_2_nm, 1e-9), 0u);
    EXPECT_EQ(reported_step_count(sign * 24.1e-9, 1, median_2_nm, 1e-9), 1u);
    EXPECT_EQ(reported_step_count(sign * 39.9e-9, 1, median_2_nm, 10e-9), 0u);
    EXPECT_EQ(reported_step_count(sign * 40.1e-9, 1, median_2_nm, 10e-9), 1u);
  }
  EXPECT_EQ(reported_step_count(1e-13, 1, {}, 0), 0u);  // rounding of exact numbers only
  EXPECT_EQ(reported_step_count(1e-11, 1, {}, 0), 1u);
}

TEST(ProbeWatchRule, IgnoresProbesWithManySteps) {
  EXPECT_EQ(reported_step_count(1e-6, 127, {}, 0), 127u);
  EXPECT_EQ(reported_step_count(1e-6, 128, {}, 0), 0u);
  EXPECT_EQ(reported_step_count(1e-6, 1000, {}, 0), 0u);
}

}  // namespace
}  // namespace mdof::algo
