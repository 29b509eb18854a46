// Jumps of the encoder in a whole log while the axis is at rest. Each jump must be found once, at
// any row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/algo/stepping_axis.h"

namespace mdof::algo {
namespace {

// From row `row` on, the reading of the encoder is larger by `by_m`. The log takes 2.5 s at 1 kHz.
struct EncoderShift {
  std::size_t row;
  double by_m;
};

std::vector<DwellEvent> find_shift_events(const std::vector<EncoderShift>& shifts,
                                          std::size_t lost_from = 0, std::size_t lost_to = 0) {
  SteppingAxis axis;
  axis.rate_hz = 1000;
  axis.wait(2.5);
  FrameBlock frames;
  frames.probe_m.resize(1);
  frames.probe_quality.resize(1);
  for (std::size_t i = 0; i < axis.frames.size(); ++i) {
    if (i >= lost_from && i < lost_to) continue;
    double more_m = 0;
    for (const EncoderShift& shift : shifts) more_m += i >= shift.row ? shift.by_m : 0;
    frames.time_ns.push_back(axis.frames.time_ns[i]);
    frames.encoder_m.push_back(axis.frames.encoder_m[i] + more_m);
    frames.probe_m[0].push_back(axis.frames.probe_m[0][i]);
  }
  DwellDetector detector({}, {"A"}, {200e-6});
  std::vector<Point> points;
  for (std::size_t i = 0; i < frames.size(); i += 100) {
    FrameBlock block;
    block.probe_m.resize(1);
    block.probe_quality.resize(1);
    for (std::size_t k = i; k < std::min(frames.size(), i + 100); ++k) {
      block.time_ns.push_back(frames.time_ns[k]);
      block.encoder_m.push_back(frames.encoder_m[k]);
      block.probe_m[0].push_back(frames.probe_m[0][k]);
    }
    detector.push(block, points);
  }
  detector.flush(points);
  return detector.events();
}

std::vector<DwellEvent> find_shift_jumps(const std::vector<EncoderShift>& shifts) {
  std::vector<DwellEvent> jumps;
  for (const DwellEvent& event : find_shift_events(shifts))
    if (event.kind == DwellEventKind::jump) jumps.push_back(event);
  return jumps;
}

// A slot of the detection has 12 or 13 rows; a window has four slots. The jump is at each row of a
// window in turn.
TEST(EncoderJumpInALog, IsFoundOnceAtEachPhaseOfTheSlot) {
  for (std::size_t row = 1000; row < 1054; ++row) {
    const auto jumps = find_shift_jumps({{row, 100e-6}});
    ASSERT_EQ(jumps.size(), 1u) << row;
    EXPECT_EQ(jumps[0].time_ns, static_cast<std::int64_t>(row) * 1'000'000) << row;
    EXPECT_NEAR(jumps[0].size_m, 100e-6, 0.1e-6) << row;
    EXPECT_NEAR(jumps[0].position_m, -1e-3, 0.1e-6) << row;
    EXPECT_EQ(jumps[0].length_s, 0) << row;
  }
}

// A jump is reported if it exceeds ten times the tolerance of 2 µm.
TEST(EncoderJumpInALog, LimitIsTenTolerances) {
  EXPECT_TRUE(find_shift_jumps({{1020, 19.8e-6}}).empty());
  EXPECT_EQ(find_shift_jumps({{1020, 20.2e-6}}).size(), 1u);
  EXPECT_EQ(find_shift_jumps({{1020, -20.2e-6}}).size(), 1u);
}

// A jump is a wrong count, and not reported, if two conditions are met: the count returns within a
// second, and the remaining difference is below half of the limit.
TEST(EncoderJumpInALog, IgnoresAJumpThatReturnsWithinASecond) {
  EXPECT_TRUE(find_shift_jumps({{1000, 100e-6}, {1990, -100e-6}}).empty());
  EXPECT_EQ(find_shift_jumps({{1000, 100e-6}, {2010, -100e-6}}).size(), 2u);
  EXPECT_TRUE(find_shift_jumps({{1000, 100e-6}, {1500, -109e-6}}).empty());
  EXPECT_EQ(find_shift_jumps({{1000, 100e-6}, {1500, -111e-6}}).size(), 2u);
  EXPECT_EQ(find_shift_jumps({{1000, 100e-6}, {1500, 100e-6}}).size(), 2u);
  // The second and third of these jumps are a wrong count.
  const auto three = find_shift_jumps({{500, 60e-6}, {1000, 100e-6}, {1500, -100e-6}});
  ASSERT_EQ(three.size(), 1u);
  EXPECT_NEAR(three[0].size_m, 60e-6, 0.1e-6);
}

// The axis moved by 100 µm during a hole in the log. The jump after the hole must not be cancelled
// by this movement.
TEST(EncoderJumpInALog, HoleIsNoJump) {
  std::size_t holes = 0, jumps = 0;
  for (const DwellEvent& event : find_shift_events({{1000, 100e-6}, {1800, -100e-6}}, 1000, 1600)) {
    holes += event.kind == DwellEventKind::hole;
    jumps += event.kind == DwellEventKind::jump;
  }
  EXPECT_EQ(holes, 1u);
  EXPECT_EQ(jumps, 1u);
}

}  // namespace
}  // namespace mdof::algo
