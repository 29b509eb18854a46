// Channels whose readings are delayed by a known time relative to their time stamps. The axis
// moves, so the delay has an effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/points/align.h"
#include "algo/points/dwell.h"

namespace mdof::algo {
namespace {

constexpr double kSpeed_m_s = 0.02,
                 kSlope = 1e-3;  // slope of the probe readings over the position

double place_m(double t_s) {
  return kSpeed_m_s * t_s;
}

// Scans of an axis at constant speed. The readings of probe A are delayed by `late_s`, those of the
// encoder and probe B are not.
SampleBlock scans(std::int64_t from_ms, std::int64_t to_ms, double late_s) {
  SampleBlock b;
  b.device = "daq";
  b.channels = {
      {kEncoderChannel, Unit::metre}, {"A", Unit::metre}, {"B", Unit::metre}, {"T", Unit::deg_c}};
  b.value.resize(b.channels.size());
  for (std::int64_t t = from_ms; t < to_ms; ++t) {
    const double t_s = static_cast<double>(t) / 1000;
    b.time_ns.push_back(t * 1'000'000);
    b.value[0].push_back(place_m(t_s));
    b.value[1].push_back(kSlope * place_m(t_s - late_s));
    b.value[2].push_back(kSlope * place_m(t_s));
    b.value[3].push_back(20);
  }
  return b;
}

FrameBlock frames(const AlignOptions& options, double late_s) {
  Aligner aligner(options, {"A", "B"});
  FrameBlock out;
  for (std::int64_t t = 0; t < 2000; t += 40) {
    SampleBlock b = scans(t, t + 40, late_s);
    EXPECT_TRUE(aligner.push(b, out));
  }
  aligner.flush(out);
  return out;
}

// Largest deviation of probe `k` from 0.1 s on, m. The result is 1 if a deviation is NaN.
double worst_m(const FrameBlock& out, std::size_t k) {
  double worst = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.time_ns[i] < 100'000'000) continue;
    const double off_m = out.probe_m[k][i] - kSlope * out.encoder_m[i];
    worst = std::isnan(off_m) ? 1 : std::max(worst, std::abs(off_m));
  }
  return worst;
}

// A delay of 6.5 ms at 20 mm/s and 1 µm/mm has an effect of 0.13 µm.
TEST(AlignDelay, IsRemovedFromItsChannel) {
  for (const double late_s : {0.0065, -0.0042, 0.25}) {
    const double error_m = kSlope * kSpeed_m_s * std::abs(late_s);
    EXPECT_NEAR(worst_m(frames({}, late_s), 0), error_m, 1e-15);
    const FrameBlock out = frames({.delay_s = {{"A", late_s}}}, late_s);
    EXPECT_LT(worst_m(out, 0), 1e-15) << late_s;
    EXPECT_LT(worst_m(out, 1), 1e-15) << late_s;
    EXPECT_NEAR(worst_m(frames({.delay_s = {{"A", -late_s}}}, late_s), 0),
                late_s > 0.2 ? 1 : 2 * error_m, 1e-15);
  }
}

// A device reads A, B and the encoder counter one after the other in intervals of 0.5 ms. The time
// stamp of the scan is the time of the first reading. The declared delay of an input is the time
// from its reading to the last reading of the scan (drivers/README.md).
TEST(AlignDelay, DelayOfSequentialInputsIsTheTimeToTheLastReading) {
  constexpr double kTurn_s = 0.5e-3;
  const auto read_aligned_frames = [&](const AlignOptions& options) {
    Aligner aligner(options, {"A", "B"});
    FrameBlock out;
    SampleBlock b = scans(0, 2000, 0);
    for (std::size_t i = 0; i < b.scans(); ++i) {
      const double t_s = static_cast<double>(b.time_ns[i]) / 1e9;
      b.value[1][i] = kSlope * place_m(t_s);
      b.value[2][i] = kSlope * place_m(t_s + kTurn_s);
      b.value[0][i] = place_m(t_s + 2 * kTurn_s);
    }
    EXPECT_TRUE(aligner.push(b, out));
    aligner.flush(out);
    return out;
  };
  const double error_m = kSlope * kSpeed_m_s * kTurn_s;
  const FrameBlock plain = read_aligned_frames({}),
                   right = read_aligned_frames({.delay_s = {{"A", 2 * kTurn_s}, {"B", kTurn_s}}}),
                   wrong = read_aligned_frames({.delay_s = {{"A", -2 * kTurn_s}, {"B", -kTurn_s}}});
  EXPECT_NEAR(worst_m(plain, 0), 2 * error_m, 1e-15);
  EXPECT_NEAR(worst_m(plain, 1), error_m, 1e-15);
  EXPECT_LT(worst_m(right, 0), 1e-15);
  EXPECT_LT(worst_m(right, 1), 1e-15);
  EXPECT_NEAR(worst_m(wrong, 0), 4 * error_m, 1e-15);
}

// The time stamps of the encoder must be unchanged, to the nanosecond. Each frame must have the
// delayed reading that belongs to its time.
TEST(AlignDelay, FramesKeepTheEncoderTime) {
  const FrameBlock out = frames({.delay_s = {{"A", 0.25}, {"B", 0}}}, 0.25);
  ASSERT_EQ(out.size(), 1750u);
  for (std::size_t i = 0; i < out.size(); ++i)
    ASSERT_EQ(out.time_ns[i], static_cast<std::int64_t>(i) * 1'000'000);
  EXPECT_TRUE(out.probe_quality[0].empty());
  EXPECT_TRUE(out.probe_quality[1].empty());
}

// The delay is shorter than a scan interval.
TEST(AlignDelay, InterpolatesBetweenScans) {
  EXPECT_LT(worst_m(frames({.delay_s = {{"A", 0.0003}}}, 0.0003), 0), 1e-15);
  EXPECT_EQ(frames({.delay_s = {{"A", 0.0003}}}, 0.0003).size(), 1999u);
}

TEST(AlignDelay, WaitsForALongDelayButNotForASilentProbe) {
  const FrameBlock out = frames({.lag_bound_s = 0.1, .delay_s = {{"A", 0.25}}}, 0.25);
  EXPECT_EQ(out.size(), 1750u);
  EXPECT_LT(worst_m(out, 0), 1e-15);
  Aligner aligner({.lag_bound_s = 0.1, .delay_s = {{"A", 0.25}}}, {"A", "B", "gone"});
  FrameBlock some;
  SampleBlock b = scans(0, 1000, 0.25);
  ASSERT_TRUE(aligner.push(b, some));
  EXPECT_EQ(aligner.waiting_for(), "gone");
  ASSERT_EQ(some.size(), 649u);  // until 0.35 s before the newest scan
  EXPECT_EQ(some.quality_at(2, 100), Quality::missing);
  EXPECT_EQ(some.quality_at(0, 100), Quality::good);
}

// The axis moves by 1 mm and then stops for 0.5 s, repeatedly. The probe has a moving mean over 161
// ms.
SampleBlock averaged_stops() {
  constexpr int kMean = 161;
  SampleBlock b;
  b.device = "daq";
  b.channels = {{kEncoderChannel, Unit::metre}, {"A", Unit::metre}};
  b.value.resize(2);
  for (int t = 0; t < 5200; ++t) {
    const int stop = t / 520, on = std::max(0, t % 520 - 500);  // motion of 20 ms
    b.time_ns.push_back(std::int64_t{1'000'000} * t);
    b.value[0].push_back(1e-3 * stop + 50e-6 * on);
  }
  for (int t = 0; t < 5200; ++t) {
    double sum_m = 0;
    for (int i = 0; i < kMean; ++i)
      sum_m += b.value[0][static_cast<std::size_t>(std::max(0, t - i))];
    b.value[1].push_back(kSlope * sum_m / kMean);
  }
  return b;
}

// Largest deviation of the probe at the stops, m.
double worst_stop_m(const AlignOptions& align, const DwellOptions& dwell) {
  Aligner aligner(align, {"A"});
  DwellDetector detector(dwell, {"A"}, {200e-6});
  SampleBlock block = averaged_stops();
  FrameBlock out;
  std::vector<Point> points;
  EXPECT_TRUE(aligner.push(block, out));
  aligner.flush(out);
  detector.push(out, points);
  detector.flush(points);
  EXPECT_GE(points.size(), 9u);
  double worst = 0;
  for (const Point& p : points)
    worst = std::max(worst, std::abs(p.probe_m[0] - kSlope * p.position_m));
  return worst;
}

// With the delay of 80 ms, one half of the moving mean is before the time of the reading, the other
// half after it. The settling time and leave_s exclude both.
TEST(AlignDelay, ExcludesFilteredMotionFromAStop) {
  const AlignOptions known{.delay_s = {{"A", 0.08}}};
  EXPECT_LT(worst_stop_m(known, {.leave_s = 0.08}), 1e-14);
  EXPECT_GT(worst_stop_m(known, {}), 1e-9);
  EXPECT_GT(worst_stop_m({}, {.leave_s = 0.08}), 1e-9);
  EXPECT_GT(worst_stop_m(known, {.settle_s = 0.03, .leave_s = 0.08}), 1e-9);
}

}  // namespace
}  // namespace mdof::algo
