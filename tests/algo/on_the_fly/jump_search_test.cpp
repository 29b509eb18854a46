// Jumps of the encoder's count during passes of an axis that moves without stopping.
#include "algo/on_the_fly/jump_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/on_the_fly/on_the_fly.h"
#include "algo/points/frame_rows.h"
#include "tests/algo/stepping_log.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr double kRate_hz = 500, kPassSpeed_m_s = 10e-3, kTravel_m = 20e-3;

// Three passes in each direction with turns of 0.1 m/s^2. From `at_s` on, the count is too large by
// `jump_m`, until `until_s`.
FrameBlock passes(double jump_m, double at_s, double until_s = 1e9) {
  FrameBlock log = empty_frames(1);
  std::mt19937_64 engine(3);
  std::normal_distribution<> unit;
  double x_m = 0, v_m_s = 0, heading = 1;
  for (int i = 0; i < 13 * 500; ++i) {
    const double t = i / kRate_hz;
    if (x_m > kTravel_m) heading = -1;
    if (x_m < 0) heading = 1;
    v_m_s = std::clamp(v_m_s + heading * 0.1 / kRate_hz, -kPassSpeed_m_s, kPassSpeed_m_s);
    x_m += v_m_s / kRate_hz;
    log.time_ns.push_back(std::llround(t * 1e9));
    log.encoder_m.push_back(x_m + 5e-9 * unit(engine) + (t >= at_s && t < until_s ? jump_m : 0));
    log.probe_m[0].push_back(1e-6 * std::sin(x_m / 3e-3) + 1e-9 * unit(engine));
  }
  return log;
}

std::string notices_of(const FrameBlock& log, std::size_t block) {
  OnTheFly run(TargetGrid({}, {}), {"A"}, {200e-6});
  for (std::size_t i = 0; i < log.size(); i += block)
    EXPECT_TRUE(run.push(cut_frames(log, i, std::min(log.size(), i + block))));
  run.flush();
  return test::shown(run.notices());
}

TEST(JumpSearch, FindsTheJumpOfTheCount) {
  for (const double um : {50.0, -50.0, 200.0, -200.0, 1000.0, -5000.0}) {
    for (const double at_s : {1.0, 3.1, 7.3}) {
      const FrameBlock log = passes(um * 1e-6, at_s);
      for (const std::size_t block : {7u, 1000u}) {
        JumpSearch search;
        for (std::size_t i = 0; i < log.size(); i += block)
          search.push(log, i, std::min(log.size(), i + block));
        search.flush();
        ASSERT_EQ(search.jumps().size(), 1u) << um << " " << at_s;
        EXPECT_NEAR(search.jumps()[0].size_m, um * 1e-6, 0.5e-6);
        EXPECT_NEAR(1e-9 * static_cast<double>(search.jumps()[0].time_ns), at_s, 0.004);
      }
    }
  }
}

TEST(JumpSearch, IsReportedAndInvalid) {
  const std::string said = notices_of(passes(200e-6, 3.1), 700);
  EXPECT_NE(said.find("encoder_jump jump_um=199.9"), std::string::npos) << said;
  EXPECT_NE(said.find("targets_shifted time_s=3.1 shift_mm=0.1999"), std::string::npos) << said;
  EXPECT_EQ(said.find("reading_delayed"), std::string::npos) << said;
}

TEST(JumpSearch, FindsNothingInAMotionWithoutJump) {
  EXPECT_EQ(notices_of(passes(0, 1), 700), notices_of(passes(0, 1), 9));
  EXPECT_EQ(notices_of(passes(0, 1), 700).find("encoder_jump"), std::string::npos);
  // A glitch: the count is right again after 0.1 s.
  const std::string glitch = notices_of(passes(300e-6, 3.1, 3.2), 700);
  EXPECT_EQ(glitch.find("encoder_jump"), std::string::npos) << glitch;
}

// Without a jump, the positions are not shifted.
TEST(JumpSearch, NoJumpShiftsNoTargets) {
  const std::string said = notices_of(passes(0, 1), 700);
  EXPECT_EQ(said.find("targets_shifted"), std::string::npos) << said;
}

}  // namespace
}  // namespace mdof::algo
