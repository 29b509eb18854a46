// All stops must be found although the encoder is noisy.
#include <gtest/gtest.h>

#include "algo/plausibility/noise_floor.h"
#include "algo/points/dwell.h"
#include "tests/algo/stepping_log.h"

namespace mdof::algo {
namespace {

std::vector<Point> detect(const SteppingLog& log, const FrameBlock& frames, std::size_t block) {
  DwellDetector detector({}, log.ids(), std::vector<double>(log.probes, 200e-6));
  std::vector<Point> points;
  for (std::size_t i = 0; i < frames.size(); i += block)
    detector.push(cut_frames(frames, i, std::min(frames.size(), i + block)), points);
  detector.flush(points);
  return points;
}

TEST(EncoderNoise, EveryStopIsFoundAtEveryRate) {
  for (const double rate : {200.0, 500.0, 1000.0, 4000.0}) {
    for (const double noise_um : {0.0, 0.05, 0.3, 1.0, 2.0}) {
      SteppingLog log;
      log.rate_hz = rate;
      log.encoder_noise_um = noise_um;
      const FrameBlock frames = log.frames();
      const auto points = detect(log, frames, 1000);
      ASSERT_EQ(points.size(), 78u) << rate << " Hz, " << noise_um << " um";
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto in_run = static_cast<int>(i % 26);
        const double target_mm = 5.0 * (in_run < 13 ? in_run : 25 - in_run);
        EXPECT_NEAR(points[i].position_m, 1e-3 * target_mm, 1e-9 + 1e-6 * noise_um);
        EXPECT_EQ(points[i].direction, in_run < 13 ? 1 : -1);
        EXPECT_TRUE(points[i].flags.empty()) << to_string(points[i].flags);
      }
    }
  }
}

TEST(EncoderNoise, FindsTheSameStopsForAnyBlockSize) {
  SteppingLog log;
  log.encoder_noise_um = 1;
  log.runs = 1;
  const FrameBlock frames = log.frames();
  const auto whole = detect(log, frames, frames.size());
  for (const std::size_t block : {1u, 17u, 1000u}) {
    const auto cut = detect(log, frames, block);
    ASSERT_EQ(cut.size(), whole.size());
    for (std::size_t i = 0; i < cut.size(); ++i) {
      EXPECT_EQ(cut[i].begin_ns, whole[i].begin_ns);
      EXPECT_EQ(cut[i].position_m, whole[i].position_m);
      EXPECT_EQ(cut[i].probe_u_m, whole[i].probe_u_m);
    }
  }
}

// In half of the slots (groups of rows) the axis is at rest. The noise in the other half is ten
// times as large.
TEST(EncoderNoise, FloorIsTheNoiseAtRest) {
  std::mt19937_64 engine(3);
  std::normal_distribution<> unit;
  for (const std::size_t rows : {4u, 6u, 12u, 50u}) {
    NoiseFloor floor;
    double a = 0, b = 0;
    for (int slot = 0; slot < 4000; ++slot) {
      const double sd = slot % 80 < 40 ? 1e-6 : 1e-5;
      double bend = 0;
      for (std::size_t i = 0; i < rows; ++i) {
        const double x = sd * unit(engine);
        bend += std::abs(x - 2 * b + a);
        a = b, b = x;
      }
      floor.add(bend / static_cast<double>(rows), rows);
    }
    EXPECT_GT(floor.sd(), 0.85e-6) << rows;
    EXPECT_LT(floor.sd(), 1.6e-6) << rows;
  }
}

}  // namespace
}  // namespace mdof::algo
