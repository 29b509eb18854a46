// Channels that come later than their time stamps say, by a known time: an axis in motion shows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/points/align.h"

namespace mdof::algo {
namespace {

constexpr double kSpeed_m_s = 0.02, kSlope = 1e-3;  // of what a probe sees against the encoder

double place_m(double t_s) {
  return kSpeed_m_s * t_s;
}

// A scan of an axis that moves evenly: encoder, A read `late_s` late, B at once.
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

// The worst of probe `k` from 0.1 s on, m.
double worst_m(const FrameBlock& out, std::size_t k) {
  double worst = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.time_ns[i] < 100'000'000) continue;
    const double off_m = out.probe_m[k][i] - kSlope * out.encoder_m[i];
    worst = std::isnan(off_m) ? 1 : std::max(worst, std::abs(off_m));
  }
  return worst;
}

// 6.5 ms at 20 mm/s and 1 µm/mm: 0.13 µm.
TEST(AlignDelay, IsTakenOutOfTheChannelThatHasIt) {
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

// The encoder's instants stay, to the nanosecond, and none is without the reading to come.
TEST(AlignDelay, FramesStayOnTheEncodersTimeAndEndWhereReadingsDo) {
  const FrameBlock out = frames({.delay_s = {{"A", 0.25}, {"B", 0}}}, 0.25);
  ASSERT_EQ(out.size(), 1750u);
  for (std::size_t i = 0; i < out.size(); ++i)
    ASSERT_EQ(out.time_ns[i], static_cast<std::int64_t>(i) * 1'000'000);
  EXPECT_TRUE(out.probe_quality[0].empty());
  EXPECT_TRUE(out.probe_quality[1].empty());
}

// With a delay of less than a scan, and one that no scan divides.
TEST(AlignDelay, BetweenScansItIsInterpolated) {
  EXPECT_LT(worst_m(frames({.delay_s = {{"A", 0.0003}}}, 0.0003), 0), 1e-15);
  EXPECT_EQ(frames({.delay_s = {{"A", 0.0003}}}, 0.0003).size(), 1999u);
}

TEST(AlignDelay, LongerThanTheLagBoundIsAwaitedAndASilentProbeIsNot) {
  const FrameBlock out = frames({.lag_bound_s = 0.1, .delay_s = {{"A", 0.25}}}, 0.25);
  EXPECT_EQ(out.size(), 1750u);
  EXPECT_LT(worst_m(out, 0), 1e-15);
  Aligner aligner({.lag_bound_s = 0.1, .delay_s = {{"A", 0.25}}}, {"A", "B", "gone"});
  FrameBlock some;
  SampleBlock b = scans(0, 1000, 0.25);
  ASSERT_TRUE(aligner.push(b, some));
  EXPECT_EQ(aligner.waiting_for(), "gone");
  ASSERT_EQ(some.size(), 649u);  // to 0.35 s before the newest
  EXPECT_EQ(some.quality_at(2, 100), Quality::missing);
  EXPECT_EQ(some.quality_at(0, 100), Quality::good);
}

}  // namespace
}  // namespace mdof::algo
