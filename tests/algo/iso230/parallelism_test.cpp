// Parallelism of two motions, and the readings of a run for ISO 230-2. All values are calculated by
// hand for four targets.
#include "algo/iso230/parallelism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algo/iso230/positioning/run_readings.h"
#include "algo/sequence/usable_runs.h"

namespace mdof::algo {
namespace {

constexpr double kReversal = 0.5e-6;  // half of it is added forward and subtracted in reverse

struct MotionByHand {
  std::int64_t id = 1;
  Axis axis = Axis::x;
  std::vector<double> x_m;            // position of the encoder
  std::vector<double> first, second;  // straightness errors, µm
  Sides sides = {};
};

mdof::Run make_motion_run(const MotionByHand& motion) {
  mdof::Run run;
  run.header.id = motion.id;
  run.header.axis = motion.axis;
  run.header.sides = motion.sides;
  run.header.state = RunState::complete;
  for (const int direction : {1, -1})
    for (std::size_t i = 0; i < motion.x_m.size(); ++i) {
      MeasuredPoint p;
      p.target = static_cast<int>(i) + 1;
      p.run = 1;
      p.point.direction = direction;
      p.point.position_m = p.target_m = motion.x_m[i];
      p.errors.valid = true;
      p.errors.local = local_from_named(run.header.moving(),
                                        {motion.first[i] * 1e-6 + direction * kReversal,
                                         motion.second[i] * 1e-6 + direction * kReversal, 0, 0, 0});
      run.points.push_back(p);
    }
  return run;
}

// The motions have the positions from 10 to 30 mm in common. There the deviations of A are 0, 3, 1
// and 0, -6, -2; the slopes of its end points, its least-squares line and its minimum zone are 1/2
// and -1 per step. Those of B are 0, 2, 0 and 0, 0, 0: all slopes are 0.
const std::vector<double> kPositionsA_m = {0, 0.01, 0.02, 0.03},
                          kPositionsB_m = {0.01, 0.02, 0.03, 0.04};
MotionByHand motion_a() {
  return {11, Axis::x, kPositionsA_m, {0, 0, 3, 1}, {0, 0, -6, -2}};
}
MotionByHand motion_b() {
  return {12, Axis::x, kPositionsB_m, {0, 2, 0, 0}, {0, 0, 0, 4}};
}

void expect_line(const ParallelismLine& line, double a_urad, double b_urad) {
  EXPECT_NEAR(line.slope_a_rad * 1e6, a_urad, 1e-6);
  EXPECT_NEAR(line.slope_b_rad * 1e6, b_urad, 1e-6);
  EXPECT_NEAR(line.angle_rad * 1e6, b_urad - a_urad, 1e-6);
}

TEST(ParallelismByHand, IsTheSlopeOfBMinusTheSlopeOfA) {
  const auto found = parallelism(make_motion_run(motion_a()), make_motion_run(motion_b()));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->run_a, 11);
  EXPECT_EQ(found->run_b, 12);
  EXPECT_EQ(found->axis, Axis::x);
  EXPECT_FALSE(found->simulated);
  EXPECT_NEAR(found->from_m, 0.01, 1e-15);
  EXPECT_NEAR(found->to_m, 0.03, 1e-15);
  ASSERT_EQ(found->planes.size(), 2u);
  EXPECT_EQ(found->planes[0].error, "EYX");
  expect_line(found->planes[0].end_point, 50, 0);
  expect_line(found->planes[0].least_squares, 50, 0);
  expect_line(found->planes[0].minimum_zone, 50, 0);
  EXPECT_EQ(found->planes[1].error, "EZX");
  expect_line(found->planes[1].end_point, -100, 0);
  expect_line(found->planes[1].least_squares, -100, 0);
  expect_line(found->planes[1].minimum_zone, -100, 0);
}

// The body moves against the encoder, in the negative direction of M. All slopes change their sign.
TEST(ParallelismByHand, IsOverTheTravelOfTheMovingBody) {
  MotionByHand a = motion_a(), b = motion_b();
  a.axis = b.axis = Axis::y;
  a.sides.against_encoder = b.sides.against_encoder = true;
  a.sides.fixture_moves = b.sides.fixture_moves = true;
  const auto found = parallelism(make_motion_run(a), make_motion_run(b));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->axis, Axis::y);
  EXPECT_NEAR(found->from_m, -0.03, 1e-15);
  EXPECT_NEAR(found->to_m, -0.01, 1e-15);
  EXPECT_EQ(found->planes[0].error, "EXY");
  EXPECT_EQ(found->planes[1].error, "EZY");
  expect_line(found->planes[0].least_squares, -50, 0);
  expect_line(found->planes[1].least_squares, 100, 0);
}

// The reference point of parallelism is the fixture. If the errors of a run refer to the origin of
// the carriage, a yaw of 10 urad contributes with its lever.
TEST(ParallelismByHand, RefersToTheFixture) {
  mdof::Run a = make_motion_run(motion_a());
  for (MeasuredPoint& p : a.points) p.errors.local[kEz] = 10e-6;
  a.header.stated = kAtCarriage;
  a.header.provenance.model = "simplified";
  const auto found = parallelism(a, make_motion_run(motion_b()));
  ASSERT_TRUE(found) << found.error().message;
  // The origin of the fixture is at -d in the frame C of the carriage (d: travel). There EYX is
  // smaller by the yaw times d.
  expect_line(found->planes[0].least_squares, 40, 0);
}

// The same curved motion over 0 to 50 mm and over 20 to 70 mm is parallel to itself. Its lines over
// the whole travels differ by 150 urad.
TEST(ParallelismByHand, OfACurvedMotionIsOverTheCommonTravel) {
  const auto over = [](std::int64_t id, double first_m, double shift_m) {
    MotionByHand motion;
    motion.id = id;
    for (int i = 0; i <= 10; ++i) {
      const double x_m = first_m + i * 5e-3 + shift_m;
      motion.x_m.push_back(x_m);
      motion.first.push_back(3 * std::sin(x_m / 8e-3));
      motion.second.push_back(40 * x_m * 1e3);
    }
    return make_motion_run(motion);
  };
  const auto found = parallelism(over(1, 0, 0), over(2, 20e-3, 0));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->planes[0].least_squares.angle_rad, 0, 1e-12);
  EXPECT_NEAR(found->planes[0].end_point.angle_rad, 0, 1e-12);
  EXPECT_NEAR(found->planes[1].least_squares.slope_b_rad, 40e-3, 1e-12);
  // The first target of run 1 is 0.4 mm before the first target of run 2: it remains in the fit.
  const auto common = over_common_travel(over(1, 0, 0), over(2, 0, 0.4e-3));
  ASSERT_TRUE(common) << common.error().message;
  EXPECT_EQ(common->a.points.size(), 22u);
  const auto farther = over_common_travel(over(1, 0, 0), over(2, 0, 0.6e-3));
  ASSERT_TRUE(farther) << farther.error().message;
  EXPECT_EQ(farther->a.points.size(), 20u);
  EXPECT_EQ(farther->b.points.size(), 20u);
}

// Positions in steps of 1/128 m have no rounding errors. The common travel must be at least half of
// the longer travel, and exactly half is enough.
TEST(ParallelismByHand, NeedsHalfOfTheTravelInCommon) {
  const auto over = [](std::int64_t id, int first) {
    MotionByHand motion;
    motion.id = id;
    for (int i = first; i < first + 5; ++i) motion.x_m.push_back(i / 128.0);
    motion.first = motion.second = {0, 1, 0, 1, 0};
    return make_motion_run(motion);
  };
  const auto half = parallelism(over(1, 0), over(2, 2));
  ASSERT_TRUE(half) << half.error().message;
  EXPECT_EQ(half->from_m, 2 / 128.0);
  EXPECT_EQ(half->to_m, 4 / 128.0);
  EXPECT_TRUE(parallelism(over(1, 2), over(2, 0)));
  const auto less = parallelism(over(1, 0), over(2, 3));
  ASSERT_FALSE(less);
  EXPECT_NE(less.error().message.find("run 1 (0 to 31.25 mm) and run 2 (23.4375"),
            std::string::npos)
      << less.error().message;
  EXPECT_FALSE(parallelism(over(1, 3), over(2, 0)));
  EXPECT_FALSE(parallelism(over(1, 0), over(2, 60)));
  // A short travel within a long one must be at least half as long.
  MotionByHand few{3, Axis::x, {1 / 128.0, 2 / 128.0, 3 / 128.0}, {0, 1, 0}, {0, 1, 0}};
  EXPECT_TRUE(parallelism(over(1, 0), make_motion_run(few)));
  few.x_m = {1 / 128.0, 1.5 / 128, 2 / 128.0};
  EXPECT_FALSE(parallelism(over(1, 0), make_motion_run(few)));
}

TEST(ParallelismByHand, RefusesIncompatibleMotions) {
  MotionByHand y = motion_b();
  y.axis = Axis::y;
  const auto two_axes = parallelism(make_motion_run(motion_a()), make_motion_run(y));
  ASSERT_FALSE(two_axes);
  EXPECT_EQ(two_axes.error().remedy, Remedy::compare_two_axes);
  EXPECT_NE(two_axes.error().message.find("run 11 measures axis X and run 12 measures axis Y"),
            std::string::npos);
  MotionByHand two = motion_b();
  two.x_m = {0.01, 0.03};
  const auto few = parallelism(make_motion_run(motion_a()), make_motion_run(two));
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().message.find("run 12"), 0u) << few.error().message;
  mdof::Run partial = make_motion_run(motion_b());
  partial.header.state = RunState::partial;
  EXPECT_FALSE(parallelism(make_motion_run(motion_a()), partial));
  EXPECT_TRUE(parallelism(make_motion_run(motion_a()), partial, true));
  mdof::Run a = make_motion_run(motion_a()), b = make_motion_run(motion_b());
  a.header.simulated = b.header.simulated = true;
  EXPECT_TRUE(parallelism(a, b)->simulated);
  b.header.simulated = false;
  EXPECT_FALSE(parallelism(a, b));
}

// The visits are 1, 2, 6 forward and 3, 4, 8 in reverse. The line through their means 2, 3, 7 is
// 1.5, 4, 6.5.
mdof::Run run_with_readings() {
  mdof::Run run;
  run.header.axis = Axis::x;
  const double forward[] = {1, 2, 6}, reverse[] = {3, 4, 8};
  for (const int direction : {1, -1})
    for (std::size_t i = 0; i < 3; ++i) {
      MeasuredPoint p;
      p.target = static_cast<int>(i) + 1;
      p.target_m = 0.01 * static_cast<double>(i);
      p.run = 4;
      p.point.direction = direction;
      p.point.position_m = p.target_m + 0.5e-3;
      p.errors.valid = true;
      const double value = (direction > 0 ? forward : reverse)[i];
      p.errors.local = local_from_named(Axis::x, {value, 10 * value, 20 * value, 0, 0});
      run.points.push_back(p);
    }
  return run;
}

TEST(RunReadingsByHand, AreDeviationsFromTheLineOfTheMeans) {
  const double off[] = {-0.5, -2, -0.5, 1.5, 0, 1.5};
  const mdof::Run run = run_with_readings();
  for (const std::size_t named : {0u, 1u}) {
    const RunReadings found = readings_of_run(run, named, false);
    ASSERT_EQ(found.readings.size(), 6u);
    EXPECT_EQ(found.left_out, 0u);
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(found.readings[j].deviation, off[j] * (named == 1 ? 10 : 1), 1e-12);
      EXPECT_EQ(found.readings[j].target_m, 0.01 * static_cast<double>(j % 3));
      EXPECT_EQ(found.readings[j].direction, j < 3 ? 1 : -1);
      EXPECT_EQ(found.readings[j].run, 4);
    }
  }
}

TEST(RunReadingsByHand, RemainUnchangedWithoutALine) {
  const double value[] = {1, 2, 6, 3, 4, 8};
  mdof::Run run = run_with_readings();
  const RunReadings kept = readings_of_run(run, 0, true), angle = readings_of_run(run, 2, false);
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_NEAR(kept.readings[j].deviation, value[j], 1e-12);
    EXPECT_NEAR(angle.readings[j].deviation, 20 * value[j], 1e-12);
  }
  // A single position determines no line.
  for (MeasuredPoint& p : run.points) p.point.position_m = 0.01;
  EXPECT_NEAR(readings_of_run(run, 0, false).readings[2].deviation, 6, 1e-12);
}

TEST(RunReadingsByHand, PointsWithoutErrorsOrApproachAreLeftOut) {
  mdof::Run run = run_with_readings();
  run.points[1].errors.valid = false;
  run.points[3].point.direction = 0;
  run.points[4].point.direction = 0;
  const RunReadings found = readings_of_run(run, 0, true);
  EXPECT_EQ(found.left_out, 3u);
  ASSERT_EQ(found.readings.size(), 3u);
  EXPECT_NEAR(found.readings[2].deviation, 8, 1e-12);
  // If the fixture moves, its errors have the opposite sign of the errors of the target.
  run.header.sides.fixture_moves = true;
  EXPECT_NEAR(readings_of_run(run, 0, true).readings[2].deviation, -8, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
