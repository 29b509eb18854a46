// Each event that the dwell detector finds (encoder jump, hole in the recording, creeping stop, too
// short stop) causes a notice, or a flag of the point.
#include <gtest/gtest.h>

#include "tests/algo/detected.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

std::vector<DwellEvent> events_with_kind(const Detected& found, DwellEventKind kind) {
  std::vector<DwellEvent> all;
  for (const DwellEvent& n : found.events)
    if (n.kind == kind) all.push_back(n);
  return all;
}

void shift_from(FrameBlock& frames, std::size_t row, double by_m) {
  for (std::size_t i = row; i < frames.size(); ++i) frames.encoder_m[i] += by_m;
}

TEST(Notices, ReportsAnEncoderJumpAndFlagsLaterPoints) {
  for (const double rate : {200.0, 500.0, 4000.0}) {
    for (const bool moving : {false, true}) {
      for (const double noise_um : {0.005, 1.0}) {
        SteppingLog log;
        log.rate_hz = rate;
        log.encoder_noise_um = noise_um;
        log.runs = 1;
        FrameBlock frames = log.frames();
        const auto clean = detect(log, frames);
        const std::int64_t at_ns =
            moving ? (clean.points[4].end_ns + clean.points[5].begin_ns) / 2 - 50'000'000
                   : (clean.points[5].begin_ns + clean.points[5].end_ns) / 2;
        const std::size_t row = row_at(frames, 1e-9 * static_cast<double>(at_ns));
        shift_from(frames, row, 100e-6);
        const auto found = detect(log, frames);
        const auto jumps = events_with_kind(found, DwellEventKind::jump);
        ASSERT_EQ(jumps.size(), 1u) << rate << " Hz, moving " << moving << ", " << noise_um;
        EXPECT_NEAR(jumps[0].size_m, 100e-6, 10e-6);
        EXPECT_NEAR(static_cast<double>(jumps[0].time_ns - frames.time_ns[row]), 0, 2e9 / rate);
        for (const Point& p : found.points)
          EXPECT_EQ(has_flag(p, Flag::jump), p.begin_ns > at_ns) << p.position_m;
        ASSERT_FALSE(found.notices.empty());
        EXPECT_EQ(found.notices[0].code, NoticeCode::encoder_jump);
        EXPECT_GT(test::number(found.notices[0], "jump_um"), 0);
      }
    }
  }
}

TEST(Notices, GlitchThatReturnsIsNoJump) {
  SteppingLog log;
  log.runs = 1;
  FrameBlock frames = log.frames();
  const std::size_t row = row_at(frames, 5.0);
  for (std::size_t i = row; i < row + 30; ++i) frames.encoder_m[i] += 200e-6;
  const auto found = detect(log, frames);
  EXPECT_TRUE(events_with_kind(found, DwellEventKind::jump).empty());
  EXPECT_FALSE(has_flag(found.points.back(), Flag::jump));
}

TEST(Notices, ReportsARecordingHole) {
  SteppingLog log;
  log.runs = 1;
  const FrameBlock whole = log.frames();
  FrameBlock frames = cut_frames(whole, 0, row_at(whole, 5.0));
  const FrameBlock rest = cut_frames(whole, row_at(whole, 8.0), whole.size());
  frames.time_ns.insert(frames.time_ns.end(), rest.time_ns.begin(), rest.time_ns.end());
  frames.encoder_m.insert(frames.encoder_m.end(), rest.encoder_m.begin(), rest.encoder_m.end());
  for (std::size_t k = 0; k < 5; ++k)
    frames.probe_m[k].insert(frames.probe_m[k].end(), rest.probe_m[k].begin(),
                             rest.probe_m[k].end());
  for (const std::size_t block : {7u, 100000u}) {
    const auto found = detect(log, frames, block);
    const auto holes = events_with_kind(found, DwellEventKind::hole);
    ASSERT_EQ(holes.size(), 1u);
    EXPECT_NEAR(holes[0].length_s, 3.0, 0.01);
    EXPECT_NEAR(1e-9 * static_cast<double>(holes[0].time_ns), 5.0, 0.01);
    EXPECT_EQ(found.notices.at(0).code, NoticeCode::recording_hole);
    EXPECT_NEAR(test::number(found.notices[0], "length_s"), 3.004, 0.005);
  }
}

// A log in which the axis stops `creep_um` before its target and creeps to the target.
FrameBlock creeping(const SteppingLog& log, double creep_um, double from_s, double to_s) {
  constexpr double kApproach_s = 0.2;
  FrameBlock frames = log.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t_s = 1e-9 * static_cast<double>(frames.time_ns[i]);
    const double remaining_approach = t_s < from_s ? std::max(0.0, 1 - (from_s - t_s) / kApproach_s)
                                                   : std::max(0.0, (to_s - t_s) / (to_s - from_s));
    frames.encoder_m[i] -= 1e-6 * creep_um * remaining_approach;
  }
  return frames;
}

TEST(Notices, ReportsACreepingStopKeptOrLeftOut) {
  SteppingLog log;
  log.runs = 1;
  const auto clean = detect(log, log.frames());
  const double from_s = 1e-9 * static_cast<double>(clean.points[2].begin_ns) - 0.13;
  const double to_s = 1e-9 * static_cast<double>(clean.points[2].end_ns) + 0.02;
  const auto little = detect(log, creeping(log, 18, from_s, to_s));
  ASSERT_EQ(little.points.size(), 26u);
  EXPECT_TRUE(has_flag(little.points[2], Flag::creep));
  EXPECT_NEAR(little.points[2].position_m, 10e-3, 18e-6);
  ASSERT_EQ(little.notices.size(), 1u);
  EXPECT_EQ(little.notices[0].code, NoticeCode::stop_crept);
  // The axis creeps in the positive direction during nearly the whole stop.
  const double length_s =
      1e-9 * static_cast<double>(clean.points[2].end_ns - clean.points[2].begin_ns);
  const auto crept = events_with_kind(little, DwellEventKind::crept);
  ASSERT_EQ(crept.size(), 1u);
  EXPECT_NEAR(crept[0].length_s, length_s, 0.1 * length_s);
  EXPECT_GT(crept[0].size_m, 5e-6);
  EXPECT_LT(crept[0].size_m, 20e-6);
  for (const double creep_um : {60.0, 100.0}) {
    const auto far = detect(log, creeping(log, creep_um, from_s, to_s));
    ASSERT_EQ(far.points.size(), 25u) << creep_um;
    ASSERT_EQ(far.notices.size(), 1u) << creep_um;
    EXPECT_EQ(far.notices[0].code, NoticeCode::stop_creeping);
    EXPECT_NEAR(test::number(far.notices[0], "position_mm"), 9.95, 0.05);
  }
}

TEST(Notices, ReportsStopsThatAreTooShort) {
  SteppingLog log;
  log.runs = 1;
  log.dwell_s = 0.15;
  log.move_s = 0.5;
  const auto found = detect(log, log.frames());
  EXPECT_TRUE(found.points.empty());
  EXPECT_EQ(events_with_kind(found, DwellEventKind::short_stop).size(), 26u);
  ASSERT_EQ(found.notices.size(), 11u);
  EXPECT_EQ(test::shown(found.notices.back()), "more_alike count=16 alike=stop_too_short");
}

}  // namespace
}  // namespace mdof::algo
