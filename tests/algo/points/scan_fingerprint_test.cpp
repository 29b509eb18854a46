// The fingerprint is the same for repeated scans, for any begin of the stop. It differs for other
// scans at the same position.
#include "algo/points/scan_fingerprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

// Readings of an axis at rest with noise of one step; they are rounded to steps of `step_m`.
FrameBlock standing(std::uint64_t seed, double step_m, std::size_t rows = 120) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<> unit;
  FrameBlock frames;
  frames.probe_m.resize(5);
  for (std::size_t i = 0; i < rows; ++i) {
    frames.time_ns.push_back(static_cast<std::int64_t>(i) * 1'000'000);
    frames.encoder_m.push_back(0.01);
    for (auto& column : frames.probe_m) column.push_back(step_m * std::round(unit(rng)));
  }
  return frames;
}

TEST(ScanFingerprint, IsEqualForAnyBeginOfTheDwell) {
  int same = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const FrameBlock frames = standing(seed, 1e-9);
    same += scan_fingerprint(frames, 0, 116) == scan_fingerprint(frames, 4, 120);
  }
  EXPECT_GE(same, 80);  // 105 of the 113 groups of scans are in both
}

TEST(ScanFingerprint, DiffersForCoarseReadingsOfOnePlace) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    EXPECT_NE(scan_fingerprint(standing(seed, 1e-9), 0, 120),
              scan_fingerprint(standing(seed + 1000, 1e-9), 0, 120));
}

TEST(ScanFingerprint, DependsOnEachColumnAndNeedsEightScans) {
  const FrameBlock frames = standing(1, 1e-9, 8);
  const std::uint64_t all = scan_fingerprint(frames, 0, 8);
  EXPECT_NE(all, 0u);
  EXPECT_EQ(scan_fingerprint(frames, 0, 7), 0u);
  FrameBlock moved = frames;
  moved.encoder_m[5] += 1e-9;
  EXPECT_NE(scan_fingerprint(moved, 0, 8), all);
  for (std::size_t k = 0; k < 5; ++k) {
    FrameBlock other = frames;
    other.probe_m[k][3] += 1e-9;
    EXPECT_NE(scan_fingerprint(other, 0, 8), all) << k;
  }
}

}  // namespace
}  // namespace mdof::algo
