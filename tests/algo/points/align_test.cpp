#include <gtest/gtest.h>

#include <cmath>

#include "algo/points/align.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

SampleBlock block(const std::string& device, const std::vector<std::string>& ids,
                  const std::vector<std::int64_t>& times_ms, double slope) {
  SampleBlock b;
  b.device = device;
  for (auto& id : ids) b.channels.push_back({id, Unit::metre});
  b.value.resize(ids.size());
  for (const auto t : times_ms) {
    b.time_ns.push_back(t * 1'000'000);
    for (auto& column : b.value) column.push_back(slope * static_cast<double>(t));
  }
  return b;
}

TEST(Aligner, CopiesOneDeviceExactlyInTheOrderOfTheRig) {
  Aligner aligner({}, {"A", "B"});
  SampleBlock b = block("dev", {"B", "extra", "encoder", "A"}, {0, 1, 2}, 0.1);
  b.value[0] = {7, 8, 9};
  FrameBlock out;
  ASSERT_TRUE(aligner.push(b, out));
  EXPECT_EQ(out.size(), 3u);
  EXPECT_EQ(out.probe_m[1], (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(out.probe_m[0], (std::vector<double>{0, 0.1, 0.2}));
}

// The aligner appends new frames until the caller clears the time column. The other columns may
// have any contents when it is cleared.
TEST(Aligner, AppendsBlocksOfOneDevice) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  for (const std::vector<std::int64_t>& times_ms : {std::vector<std::int64_t>{0, 1}, {2}, {3, 4}}) {
    SampleBlock b = block("dev", {"A", "encoder"}, times_ms, 2.0);
    ASSERT_TRUE(aligner.push(b, out));
  }
  EXPECT_EQ(out.time_ns,
            (std::vector<std::int64_t>{0, 1'000'000, 2'000'000, 3'000'000, 4'000'000}));
  EXPECT_EQ(out.probe_m[0], (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_EQ(out.encoder_m, (std::vector<double>{0, 2, 4, 6, 8}));
  out.time_ns.clear();
  SampleBlock b = block("dev", {"A", "encoder"}, {5}, 2.0);
  ASSERT_TRUE(aligner.push(b, out));
  EXPECT_EQ(out.time_ns, std::vector<std::int64_t>{5'000'000});
  EXPECT_EQ(out.probe_m[0], std::vector<double>{10});
  EXPECT_EQ(out.encoder_m, std::vector<double>{10});
}

// After the frames are cleared, their marks must not apply to the next frames.
TEST(Aligner, ClearedFramesLeaveNoMarks) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  SampleBlock b = block("dev", {"A", "encoder"}, {0}, 2.0);
  b.quality = {{Quality::suspect}, {Quality::good}};
  ASSERT_TRUE(aligner.push(b, out));
  EXPECT_EQ(out.quality_at(0, 0), Quality::suspect);
  out.time_ns.clear();
  b = block("dev", {"A", "encoder"}, {1}, 2.0);
  ASSERT_TRUE(aligner.push(b, out));
  EXPECT_TRUE(out.probe_quality[0].empty());
}

// If a probe sample has the same time as the encoder sample, the aligner needs no later probe
// sample.
TEST(Aligner, NeedsNoLaterSampleAtTheSameInstant) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  SampleBlock probe = block("p", {"A"}, {0, 4}, 2.0);
  SampleBlock encoder = block("e", {"encoder"}, {4, 5}, 1.0);
  ASSERT_TRUE(aligner.push(probe, out));
  ASSERT_TRUE(aligner.push(encoder, out));
  EXPECT_EQ(out.probe_m[0], std::vector<double>{8});
}

TEST(Aligner, WaitsForNothingAtTheBeginning) {
  EXPECT_EQ(Aligner({}, {"A"}).waiting_for(), std::nullopt);
}

TEST(Aligner, InterpolatesOtherDevicesAtTheTimesOfTheEncoder) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  SampleBlock probe = block("p", {"A"}, {0, 4, 8, 12}, 2.0);
  SampleBlock encoder = block("e", {"encoder"}, {1, 4, 7, 11}, 1.0);
  ASSERT_TRUE(aligner.push(encoder, out));
  EXPECT_EQ(out.size(), 0u);
  EXPECT_EQ(aligner.waiting_for(), "A");
  ASSERT_TRUE(aligner.push(probe, out));
  EXPECT_EQ(out.probe_m[0], (std::vector<double>{2, 8, 14, 22}));
  EXPECT_EQ(aligner.waiting_for(), std::nullopt);
}

TEST(Aligner, DoesNotInterpolateIntoAGap) {
  Aligner aligner({.max_gap_s = 0.01}, {"A"});
  FrameBlock out;
  SampleBlock probe = block("p", {"A"}, {0, 50}, 1.0), encoder = block("e", {"encoder"}, {20}, 1.0);
  ASSERT_TRUE(aligner.push(probe, out));
  ASSERT_TRUE(aligner.push(encoder, out));
  ASSERT_EQ(out.size(), 1u);
  EXPECT_TRUE(std::isnan(out.probe_m[0][0]));
  EXPECT_EQ(out.quality_at(0, 0), Quality::missing);
}

TEST(Aligner, GivesUpASilentProbeAfterTheLagBound) {
  Aligner aligner({.lag_bound_s = 0.1}, {"A", "B"});
  FrameBlock out;
  for (int t = 0; t < 300; t += 10) {
    SampleBlock a = block("a", {"A"}, {t}, 1.0), e = block("e", {"encoder"}, {t}, 1.0);
    ASSERT_TRUE(aligner.push(a, out));
    ASSERT_TRUE(aligner.push(e, out));
  }
  EXPECT_EQ(aligner.waiting_for(), "B");
  EXPECT_GE(out.size(), 15u);
  EXPECT_LT(out.size(), 25u);
  EXPECT_EQ(out.quality_at(1, 3), Quality::missing);
  EXPECT_EQ(out.probe_m[0][3], 30.0);
  EXPECT_EQ(aligner.given_up(), out.size());
}

TEST(Aligner, RejectsTimeThatGoesBackwards) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  SampleBlock b = block("dev", {"A", "encoder"}, {5, 6}, 1.0),
              again = block("dev", {"A", "encoder"}, {6, 7}, 1.0);
  ASSERT_TRUE(aligner.push(b, out));
  const auto refused = aligner.push(again, out);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("dev"), std::string::npos);
}

TEST(Aligner, FlushReturnsPendingFrames) {
  Aligner aligner({}, {"A"});
  FrameBlock out;
  SampleBlock e = block("e", {"encoder"}, {1, 2}, 1.0);
  ASSERT_TRUE(aligner.push(e, out));
  aligner.flush(out);
  EXPECT_EQ(out.size(), 2u);
  EXPECT_EQ(out.quality_at(0, 1), Quality::missing);
}

// With one device and with two: if the encoder sample is suspect or missing, no probe reading of
// the frame is good.
TEST(Aligner, QualityOfAReadingIsNoBetterThanOfItsPosition) {
  const std::vector<Quality> of_encoder = {Quality::good, Quality::suspect, Quality::missing};
  Aligner one({}, {"A"}), two({}, {"A"});
  FrameBlock together, apart;
  SampleBlock both;
  both.device = "daq";
  both.channels = {{"A", Unit::metre}, {kEncoderChannel, Unit::metre}};
  both.time_ns = {1000, 2000, 3000};
  both.value = {{1, 2, 3}, {0, 0, kNaN}};
  both.quality = {{}, of_encoder};
  SampleBlock probe, encoder;
  probe.device = "a";
  probe.channels = {both.channels[0]};
  probe.time_ns = encoder.time_ns = both.time_ns;
  probe.value = {both.value[0]};
  encoder.device = "b";
  encoder.channels = {both.channels[1]};
  encoder.value = {both.value[1]};
  encoder.quality = {of_encoder};
  ASSERT_TRUE(one.push(both, together));
  ASSERT_TRUE(two.push(probe, apart));
  ASSERT_TRUE(two.push(encoder, apart));
  for (const FrameBlock* frames : {&together, &apart}) {
    ASSERT_EQ(frames->size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(frames->quality_at(0, i), of_encoder[i]) << i;
  }
}

// Two probes send at 1 kHz for ten minutes without the encoder; then the encoder returns. The
// number of pending samples must be limited to about twice the lag bound. The frames after the
// return must be correct.
TEST(Aligner, SilentEncoderDoesNotFillTheMemory) {
  Aligner aligner({.lag_bound_s = 3}, {"A", "B"});
  FrameBlock out;
  std::size_t most = 0;
  const auto probes_until = [&](std::int64_t from_ms, std::int64_t to_ms) {
    for (std::int64_t t = from_ms; t < to_ms; t += 100) {
      std::vector<std::int64_t> times;
      for (std::int64_t i = 0; i < 100; ++i) times.push_back(t + i);
      SampleBlock b = block("p", {"A", "B"}, times, 2.0);
      ASSERT_TRUE(aligner.push(b, out));
      most = std::max(most, aligner.waiting());
    }
  };
  probes_until(0, 600'000);
  EXPECT_EQ(out.size(), 0u);
  EXPECT_EQ(aligner.waiting_for(), kEncoderChannel);
  EXPECT_LE(most, 2u * (7000 + 200));  // 7 s of two probes
  // The encoder sends the samples of the last 2.5 s late, and then new samples.
  SampleBlock late = block("e", {"encoder"}, {597'500, 598'000, 599'999}, 1.0);
  ASSERT_TRUE(aligner.push(late, out));
  ASSERT_EQ(out.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(out.probe_m[0][i], 2 * out.encoder_m[i]);
    EXPECT_EQ(out.quality_at(1, i), Quality::good);
  }
}

// The probe sends at 10 Hz, the encoder at 1 kHz, for 30 s; the probe reads 2 t. At 12 s one sample
// is missing: an interval of two periods is no gap. At 20 s three samples are missing, which is a
// gap.
struct Slow {
  FrameBlock out;
  std::map<std::string, Notice> too_slow;
  std::size_t missing = 0;
  double worst = 0;

  explicit Slow(AlignOptions options) {
    Aligner aligner(std::move(options), {"A"});
    for (std::int64_t t = 0; t <= 30'000; t += 100) {
      std::vector<std::int64_t> times;
      for (std::int64_t i = 0; i < 100; ++i) times.push_back(t + i + 1);
      SampleBlock e = block("e", {"encoder"}, times, 1.0), p = block("p", {"A"}, {t}, 2.0);
      const bool lost = t == 12'000 || (t >= 20'000 && t < 20'300);
      EXPECT_TRUE(aligner.push(e, out));
      if (!lost) {
        EXPECT_TRUE(aligner.push(p, out));
      }
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      missing += out.quality_at(0, i) == Quality::missing;
      if (!std::isnan(out.probe_m[0][i]))
        worst = std::max(worst, std::abs(out.probe_m[0][i] - 2 * out.encoder_m[i]));
    }
    too_slow = aligner.too_slow();
  }
};

TEST(Aligner, InterpolatesASlowProbeByItsInterval) {
  const Slow known({.interval_s = {{"A", 0.1}}});
  EXPECT_GE(known.out.size(), 29'900u);
  EXPECT_NEAR(static_cast<double>(known.missing), 399, 2);  // from 19.9 to 20.3 s
  EXPECT_LT(known.worst, 1e-6);
  EXPECT_TRUE(known.too_slow.empty());
}

TEST(Aligner, ReportsAnUndeclaredSlowProbe) {
  const Slow unknown({});
  EXPECT_GT(unknown.missing, 29'000u);
  ASSERT_EQ(unknown.too_slow.count("A"), 1u);
  EXPECT_NEAR(test::number(unknown.too_slow.at("A"), "apart_s"), 0.1, 1e-9);
  EXPECT_NEAR(test::number(unknown.too_slow.at("A"), "needed_gap_s"), 0.25, 1e-9);
}

// One device scans the encoder and probe A at 5 Hz for 20 s; the readings are 8 ms late, so A reads
// 2 (t - 8 ms), in ms. At 8 s one scan is missing, at 14 s four scans are missing. An interval of
// two periods is no gap; the five periods from 13.8 to 14.8 s are a gap.
struct SlowScans {
  FrameBlock out;
  std::size_t missing = 0;
  double worst = 0;

  explicit SlowScans(std::int64_t blocks_of) {
    Aligner aligner({.delay_s = {{"A", 0.008}}}, {"A"});
    std::vector<std::int64_t> times;
    for (std::int64_t t = 0; t <= 20'000; t += 200) {
      if (t != 8'000 && (t < 14'000 || t >= 14'800)) times.push_back(t);
      if (t < 20'000 && static_cast<std::int64_t>(times.size()) < blocks_of) continue;
      SampleBlock scans = block("log", {"encoder", "A"}, times, 1.0);
      for (double& a : scans.value[1]) a = 2 * (a - 8);
      EXPECT_TRUE(aligner.push(scans, out));
      times.clear();
    }
    aligner.flush(out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      missing += out.quality_at(0, i) == Quality::missing;
      if (!std::isnan(out.probe_m[0][i]))
        worst = std::max(worst, std::abs(out.probe_m[0][i] - 2 * out.encoder_m[i]));
    }
  }
};

// 101 scans less 5; the last scan has no delayed reading. The scan before the gap is missing.
TEST(Aligner, CorrectsDelaysOfScansThatAreSlowerThanTheGap) {
  for (const std::int64_t blocks_of : {1, 7, 1000}) {
    const SlowScans slow(blocks_of);
    EXPECT_EQ(slow.out.size(), 95u) << blocks_of;
    EXPECT_EQ(slow.missing, 1u) << blocks_of;
    EXPECT_LT(slow.worst, 1e-9) << blocks_of;
  }
}

// A probe sends every 2 ms, the encoder every 1 ms. The row between two readings is the first that
// uses the later reading, so it is fresh. The row at the later reading repeats it. A probe that is
// as fast as the encoder has no marks.
TEST(Aligner, MarksRepeatedReadingsOfASlowerProbe) {
  Aligner aligner({}, {"slow", "fast"});
  FrameBlock out;
  SampleBlock slow = block("s", {"slow"}, {0, 2, 4, 6}, 2.0);
  SampleBlock fast = block("f", {"fast"}, {0, 1, 2, 3, 4, 5, 6}, 3.0);
  SampleBlock encoder = block("e", {"encoder"}, {0, 1, 2, 3, 4, 5}, 1.0);
  for (SampleBlock* b : {&slow, &fast, &encoder}) ASSERT_TRUE(aligner.push(*b, out));
  ASSERT_EQ(out.size(), 6u);
  ASSERT_EQ(out.probe_is_new.size(), 2u);
  EXPECT_EQ(out.probe_is_new[0], (std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1}));
  EXPECT_TRUE(out.probe_is_new[1].empty());
}

// The encoder sent samples and then sends nothing for longer than the lag bound. The aligner must
// wait for it.
TEST(Aligner, WaitsForAnEncoderThatFellSilent) {
  Aligner aligner({.lag_bound_s = 0.1}, {"A"});
  FrameBlock out;
  SampleBlock before = block("p", {"A"}, {0, 10}, 1.0), encoder = block("e", {"encoder"}, {5}, 1.0);
  ASSERT_TRUE(aligner.push(before, out));
  ASSERT_TRUE(aligner.push(encoder, out));
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(aligner.waiting_for(), std::nullopt);
  SampleBlock within = block("p", {"A"}, {20, 105}, 1.0);
  ASSERT_TRUE(aligner.push(within, out));
  EXPECT_EQ(aligner.waiting_for(), std::nullopt);
  SampleBlock beyond = block("p", {"A"}, {106}, 1.0);
  ASSERT_TRUE(aligner.push(beyond, out));
  EXPECT_EQ(aligner.waiting_for(), kEncoderChannel);
}

}  // namespace
}  // namespace mdof::algo
