// Jumps of known size and single spikes of an encoder. The axis moves at speeds up to 10 mm/s in
// both directions.
#include "algo/plausibility/encoder/encoder_jump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::int64_t kScan_ns = 1'000'000;
constexpr std::size_t kRows = 60, kAt = 30;

// Encoder readings of kRows scans in intervals of 1 ms. The jump is at row kAt.
struct Motion {
  double speed_mm_s = 0, acceleration_m_s2 = 0, jump_um = 0, noise_um = 0;
  std::uint64_t seed = 1;

  std::vector<double> encoder_m() const {
    std::mt19937_64 random(seed);
    std::normal_distribution<> unit;
    std::vector<double> rows;
    for (std::size_t i = 0; i < kRows; ++i) {
      const double t_s = 1e-3 * static_cast<double>(i);
      rows.push_back(1e-3 * speed_mm_s * t_s + 0.5 * acceleration_m_s2 * t_s * t_s +
                     (i >= kAt ? 1e-6 * jump_um : 0) + 1e-6 * noise_um * unit(random));
    }
    return rows;
  }
};

std::optional<EncoderJump> jump_among(const std::vector<double>& encoder_m, double least_um = 5) {
  std::vector<std::int64_t> time_ns;
  for (std::size_t i = 0; i < encoder_m.size(); ++i)
    time_ns.push_back(static_cast<std::int64_t>(i) * kScan_ns);
  return find_jump(time_ns, encoder_m, 0, encoder_m.size(), kScan_ns, 1e-6 * least_um);
}

const std::vector<double> kSpeeds_mm_s = {-10, -9.9, -5, -2, -0.3, 0, 0.3, 2, 5, 9.9, 10};

TEST(EncoderJumpInMotion, SizeIsCorrectInBothDirections) {
  for (const double speed : kSpeeds_mm_s) {
    for (const double size : {-500.0, -100.0, -20.0, -6.0, 6.0, 20.0, 100.0, 500.0}) {
      const auto jump = jump_among(Motion{.speed_mm_s = speed, .jump_um = size}.encoder_m());
      ASSERT_TRUE(jump) << speed << " mm/s, " << size << " um";
      EXPECT_NEAR(jump->size_m, 1e-6 * size, 1e-12) << speed << " mm/s";
      EXPECT_EQ(jump->time_ns, static_cast<std::int64_t>(kAt) * kScan_ns);
      EXPECT_NEAR(jump->position_m, 1e-6 * speed * (kAt - 1), 1e-12);
    }
  }
}

TEST(EncoderJumpInMotion, SpikeOfOneScanIsNoJumpAtAnySpeed) {
  for (const double speed : kSpeeds_mm_s) {
    for (const double spike_um : {-500.0, -30.0, -8.0, 8.0, 30.0, 500.0, 2e8}) {
      for (std::size_t at = 10; at < 50; at += 3) {
        auto rows = Motion{.speed_mm_s = speed}.encoder_m();
        rows[at] += 1e-6 * spike_um;
        EXPECT_FALSE(jump_among(rows)) << speed << " mm/s, spike of " << spike_um << " at " << at;
      }
    }
  }
}

// The axis accelerates. The size of a jump has an error of at most twice the change of the speed
// per scan, times the scan interval.
TEST(EncoderJumpInMotion, AccelerationIsNoJump) {
  for (const double speed : kSpeeds_mm_s) {
    for (const double acceleration : {-5.0, -1.0, 1.0, 5.0}) {
      Motion motion{.speed_mm_s = speed, .acceleration_m_s2 = acceleration};
      EXPECT_FALSE(jump_among(motion.encoder_m(), 0.1)) << speed << " " << acceleration;
      for (const double size : {-100.0, 100.0}) {
        motion.jump_um = size;
        const auto jump = jump_among(motion.encoder_m());
        ASSERT_TRUE(jump) << speed << " " << acceleration << " " << size;
        EXPECT_NEAR(jump->size_m, 1e-6 * size, 2e-6 * std::abs(acceleration)) << speed;
      }
    }
  }
}

// The axis starts or stops within one scan. This is no jump.
TEST(EncoderJumpInMotion, StartOrStopIsNoJump) {
  for (const double speed : kSpeeds_mm_s) {
    std::vector<double> start(kRows), stop(kRows);
    for (std::size_t i = 0; i < kRows; ++i) {
      const double before = static_cast<double>(std::min(i, kAt));
      start[i] = 1e-6 * speed * (static_cast<double>(i) - before);
      stop[i] = 1e-6 * speed * before;
    }
    EXPECT_FALSE(jump_among(start, 1)) << speed;
    EXPECT_FALSE(jump_among(stop, 1)) << speed;
  }
}

// The encoder repeats each count for two or three scans.
TEST(EncoderJumpInMotion, RepeatedCountsAreNoJump) {
  for (const double speed : kSpeeds_mm_s) {
    for (const std::size_t scans : {2u, 3u}) {
      auto rows = Motion{.speed_mm_s = speed}.encoder_m();
      for (std::size_t i = 0; i < kRows; ++i) rows[i] = rows[i - i % scans];
      EXPECT_FALSE(jump_among(rows, 1)) << speed << " mm/s, " << scans << " scans";
    }
  }
}

// The noise is 0.2 um. It must not cause a false jump, and the size of a jump must be correct
// within the noise of four readings.
TEST(EncoderJumpInMotion, NoiseNeitherCausesNorHidesAJump) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const double speed = kSpeeds_mm_s[seed % kSpeeds_mm_s.size()];
    Motion motion{.speed_mm_s = speed, .noise_um = 0.2, .seed = seed};
    EXPECT_FALSE(jump_among(motion.encoder_m())) << seed;
    motion.jump_um = seed % 2 == 0 ? 20 : -20;
    const auto jump = jump_among(motion.encoder_m());
    ASSERT_TRUE(jump) << seed;
    EXPECT_NEAR(jump->size_m, 1e-6 * motion.jump_um, 1.5e-6) << seed;
  }
}

// A jump over two scans consists of two steps of the same size. Such a movement is attributed to
// the axis.
TEST(EncoderJumpInMotion, JumpOverTwoScansIsRejected) {
  for (const double speed : kSpeeds_mm_s) {
    auto rows = Motion{.speed_mm_s = speed, .jump_um = 100}.encoder_m();
    rows[kAt] -= 50e-6;
    EXPECT_FALSE(jump_among(rows)) << speed;
    rows[kAt] += 40e-6;  // steps of 90 and 10 um: the larger is more than four times the smaller
    EXPECT_TRUE(jump_among(rows)) << speed;
  }
}

// Another jump three scans earlier or later changes the speed before or after this jump. A sixth of
// its size is added to the size of this jump and to the size of the neighbouring step. A jump must
// be four times as large as the neighbouring steps.
TEST(EncoderJumpInMotion, JumpBesideALargeJumpIsRejected) {
  for (const std::size_t other : {kAt - 3, kAt + 3}) {
    for (const double size_um : {30.0, 50.0}) {
      auto rows = Motion{.speed_mm_s = 2, .jump_um = 100}.encoder_m();
      for (std::size_t i = other; i < kRows; ++i) rows[i] += 1e-6 * size_um;
      const auto jump = jump_among(rows);
      ASSERT_EQ(jump.has_value(), size_um == 30) << other;
      if (jump) {
        EXPECT_NEAR(jump->size_m, 95e-6, 1e-12);
      }
    }
  }
}

// The rows before row kAt are not in the log. Without a jump, the larger step of the encoder is the
// motion of the axis. A jump during the gap is found with its size.
TEST(EncoderJumpInMotion, MissingRowsAreNoJump) {
  for (const double speed : kSpeeds_mm_s) {
    for (const std::size_t lost : {1u, 2u, 3u}) {
      for (const double size_um : {0.0, 100.0, -100.0}) {
        auto rows = Motion{.speed_mm_s = speed, .jump_um = size_um}.encoder_m();
        std::vector<std::int64_t> time_ns;
        for (std::size_t i = 0; i < kRows; ++i)
          time_ns.push_back(static_cast<std::int64_t>(i) * kScan_ns);
        rows.erase(rows.begin() + kAt - lost, rows.begin() + kAt);
        time_ns.erase(time_ns.begin() + kAt - lost, time_ns.begin() + kAt);
        const auto jump = find_jump(time_ns, rows, 0, rows.size(), kScan_ns, 5e-6);
        ASSERT_EQ(jump.has_value(), size_um != 0) << speed << " mm/s, lost " << lost;
        if (jump) {
          EXPECT_NEAR(jump->size_m, 1e-6 * size_um, 1e-12) << speed << " mm/s, lost " << lost;
        }
      }
    }
  }
}

// The axis starts or stops while rows are lost, so its motion in these rows is unknown.
TEST(EncoderJumpInMotion, StartOrStopInMissingRowsIsNoJump) {
  for (const double speed : kSpeeds_mm_s) {
    for (std::size_t from = kAt - 3; from <= kAt; ++from) {
      std::vector<double> start, stop;
      std::vector<std::int64_t> time_ns;
      for (std::size_t i = 0; i < kRows; ++i) {
        if (i >= kAt - 3 && i < kAt) continue;
        const double before = static_cast<double>(std::min(i, from));
        start.push_back(1e-6 * speed * (static_cast<double>(i) - before));
        stop.push_back(1e-6 * speed * before);
        time_ns.push_back(static_cast<std::int64_t>(i) * kScan_ns);
      }
      for (const auto& rows : {start, stop})
        EXPECT_FALSE(find_jump(time_ns, rows, 0, rows.size(), kScan_ns, 1e-6)) << speed;
    }
  }
}

TEST(EncoderJumpInMotion, MissingPositionsAreNoJump) {
  auto rows = Motion{.speed_mm_s = 10}.encoder_m();
  for (std::size_t i = 25; i < 35; ++i) rows[i] = kNaN;
  EXPECT_FALSE(jump_among(rows));
  rows.assign(kRows, kNaN);
  EXPECT_FALSE(jump_among(rows));
}

}  // namespace
}  // namespace mdof::algo
