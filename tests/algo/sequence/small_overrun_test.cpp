// An axis that overruns its end targets by a small distance: the approach of each stop. The motion
// has a limited acceleration, and the truth is the last move that the test commanded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"

namespace mdof::algo {
namespace {

struct Stage {
  double rate_hz = 1000, speed_m_s = 0.01, acceleration_m_s2 = 0.5, noise_m = 5e-9, x_m = 0;
  FrameBlock log;
  std::mt19937_64 engine{7};

  Stage() : log{{}, {}, {{}}, {{}}, {}} {}

  void scan() {
    std::normal_distribution<> unit;
    log.time_ns.push_back(std::llround(static_cast<double>(log.size()) / rate_hz * 1e9));
    log.encoder_m.push_back(x_m + noise_m * unit(engine));
    log.probe_m[0].push_back(0);
  }
  void wait(double s) {
    for (int i = 0; i < std::lround(s * rate_hz); ++i) scan();
  }
  void move_to(double to_m) {
    const double from_m = x_m, way_m = std::abs(to_m - x_m), a = acceleration_m_s2;
    const double v = std::min(speed_m_s, std::sqrt(way_m * a)), ramp_s = v / a;
    const double all_s = way_m > 0 ? way_m / v + ramp_s : 0, ramp_m = 0.5 * v * ramp_s;
    for (double t = 1 / rate_hz; t < all_s; t += 1 / rate_hz) {
      const double rest_s = all_s - t;
      const double s = t < ramp_s        ? 0.5 * a * t * t
                       : rest_s < ramp_s ? way_m - 0.5 * a * rest_s * rest_s
                                         : ramp_m + v * (t - ramp_s);
      x_m = from_m + (to_m > from_m ? s : -s);
      scan();
    }
    x_m = to_m;
  }
  Sequence sequence(const std::vector<double>& targets_m) const {
    DwellDetector detector({}, {"A"}, {200e-6});
    std::vector<Point> points;
    detector.push(log, points);
    detector.flush(points);
    return recognise_sequence(points, {targets_m});
  }
};

bool has(const Sequence& s, NoticeCode code) {
  return std::any_of(s.notices.begin(), s.notices.end(),
                     [&](const Notice& n) { return n.code == code; });
}

struct Wrong {
  int approaches = 0, positions = 0;
  std::size_t points = 0;
};

// Three passes in each direction over the targets; the axis turns `overrun_m` beyond both ends.
Wrong wrong_after_overrun(Stage stage, std::vector<double> targets_m, double overrun_m,
                          double turn_s, bool given) {
  std::vector<int> approaches;
  std::vector<double> positions_m;
  const auto stop = [&](double at_m, int approach) {
    stage.move_to(at_m);
    stage.wait(0.5);
    approaches.push_back(approach);
    positions_m.push_back(at_m);
  };
  stage.x_m = targets_m.front() - 1e-3;
  for (int run = 0; run < 3; ++run) {
    for (const double t : targets_m) stop(t, 1);
    stage.move_to(targets_m.back() + overrun_m);
    stage.wait(turn_s);
    for (auto t = targets_m.rbegin(); t != targets_m.rend(); ++t) stop(*t, -1);
    stage.move_to(targets_m.front() - overrun_m);
    stage.wait(turn_s);
  }
  const Sequence found = stage.sequence(given ? targets_m : std::vector<double>{});
  Wrong wrong;
  wrong.points = found.points.size();
  for (std::size_t i = 0; i < std::min(approaches.size(), wrong.points); ++i) {
    wrong.approaches += found.points[i].point.direction != approaches[i];
    wrong.positions += std::abs(found.points[i].point.position_m - positions_m[i]) > 1e-6;
  }
  EXPECT_FALSE(has(found, NoticeCode::stops_merged));
  EXPECT_EQ(found.cycle, Cycle::standard);
  return wrong;
}

TEST(SmallOverrun, GivesTheApproachOfTheLastMotion) {
  const std::vector<double> targets_m = {0, 5e-3, 10e-3, 15e-3, 20e-3};
  for (const double um : {20.0, 30.0, 50.0, 70.0, 100.0, 150.0, 200.0}) {
    for (const double rate_hz : {100.0, 1000.0}) {
      for (const double speed_m_s : {0.005, 0.01}) {
        for (const double turn_s : {0.0, 0.1}) {
          for (const bool given : {false, true}) {
            // The stage is beyond the target for fewer than three scans.
            if (um < 50 && rate_hz < 1000) continue;
            Stage stage;
            stage.rate_hz = rate_hz;
            stage.speed_m_s = speed_m_s;
            stage.acceleration_m_s2 = speed_m_s < 0.01 ? 0.1 : 0.5;
            const Wrong wrong = wrong_after_overrun(stage, targets_m, um * 1e-6, turn_s, given);
            EXPECT_EQ(wrong.points, 30u) << um << " " << rate_hz << " " << speed_m_s << turn_s;
            EXPECT_EQ(wrong.approaches, 0) << um << " " << rate_hz << " " << speed_m_s << turn_s;
            EXPECT_EQ(wrong.positions, 0);
          }
        }
      }
    }
  }
}

// The targets are closer to each other than the shortest path of the direction (50 um).
TEST(SmallOverrun, GivesTheApproachAtCloseTargets) {
  std::vector<double> targets_m;
  for (int i = 0; i < 11; ++i) targets_m.push_back(20e-6 * i);
  Stage stage;
  stage.speed_m_s = 1e-3;
  const Wrong wrong = wrong_after_overrun(stage, targets_m, 50e-6, 0, true);
  EXPECT_EQ(wrong.points, 66u);
  EXPECT_EQ(wrong.approaches, 0);
}

// The distance to the turn is 20 times the distance of the targets, so it decides the ratio.
TEST(CloseTargets, AreSeparateTargets) {
  for (const double step_m : {5e-6, 10e-6, 20e-6}) {
    std::vector<double> targets_m;
    for (int i = 0; i < 11; ++i) targets_m.push_back(step_m * i);
    Stage stage;
    stage.speed_m_s = 1e-3;
    const Wrong wrong = wrong_after_overrun(stage, targets_m, 0.2e-3, 0, false);
    EXPECT_EQ(wrong.points, 66u) << step_m;
    EXPECT_EQ(wrong.approaches, 0) << step_m;
    EXPECT_EQ(wrong.positions, 0) << step_m;
  }
}

// The stops of a step cycle scatter by some micrometres about each target.
TEST(CloseTargets, AreNotTheScatterOfAStepCycle) {
  Stage stage;
  stage.x_m = -1e-3;
  for (const double t : {0.0, 5e-3, 10e-3, 15e-3}) {
    for (int k = 0; k < 4; ++k) {
      stage.move_to(t + (k % 2 == 0 ? -0.5e-3 : 0.5e-3));
      stage.move_to(t + 4e-6 * k);
      stage.wait(0.5);
    }
  }
  const Sequence found = stage.sequence({});
  EXPECT_EQ(found.targets, 4);
  EXPECT_EQ(found.points.size(), 16u);
  EXPECT_EQ(found.cycle, Cycle::pilgrim);
}

// A servo that overshoots each target by 30 um: the approach is the direction of travel.
TEST(SmallOverrun, IsNoOvershootOfATarget) {
  Stage stage;
  stage.x_m = -1e-3;
  for (const double t : {0.0, 5e-3, 10e-3, 15e-3}) {
    stage.move_to(t + 30e-6);
    stage.move_to(t);
    stage.wait(0.5);
  }
  const Sequence found = stage.sequence({});
  ASSERT_EQ(found.points.size(), 4u);
  for (const MeasuredPoint& p : found.points) EXPECT_EQ(p.point.direction, 1);
}

// A vibration moves the axis to both sides, so the stop is one interrupted stop. A notice states
// the motion.
TEST(SmallOverrun, IsNoVibration) {
  Stage stage;
  stage.x_m = -1e-3;
  for (const double t : {0.0, 5e-3, 10e-3}) {
    stage.move_to(t);
    stage.wait(0.5);
    for (int i = 0; t == 5e-3 && i < 200; ++i) {
      stage.x_m = t + 20e-6 * std::sin(0.1 * i);
      stage.scan();
    }
    stage.x_m = t;
    stage.wait(0.5);
  }
  const Sequence found = stage.sequence({});
  ASSERT_EQ(found.points.size(), 3u);
  EXPECT_EQ(found.points[1].point.direction, 1);
  EXPECT_TRUE(has(found, NoticeCode::stops_merged));
}

// A disturbance of 8 um interrupts the stop. After a motion of 40 um, the axis approached the
// target from the other side.
TEST(SmallOverrun, BeginsAtTenMicrometres) {
  for (const double by_m : {8e-6, 40e-6}) {
    Stage stage;
    stage.x_m = -1e-3;
    for (const double at_m : {0.0, by_m, 0.0, 2e-3}) {
      stage.move_to(at_m);
      stage.wait(at_m == by_m ? 0.02 : 0.5);
    }
    const Sequence found = stage.sequence({});
    const bool is_merged = by_m < 10e-6;
    ASSERT_EQ(found.points.size(), is_merged ? 2u : 3u);
    EXPECT_EQ(has(found, NoticeCode::stops_merged), is_merged);
    EXPECT_EQ(found.points[0].point.flags.size(), is_merged ? 1u : 0u);
    EXPECT_EQ(found.points[0].point.direction, 1);
    EXPECT_EQ(found.points[1].point.direction, is_merged ? 1 : -1);
  }
}

// The axis is parked 30 um before the first target, nearer than the scatter of the stops.
TEST(SmallOverrun, KeepsTheStopAtTheTargetAndNotTheParkedAxis) {
  for (const bool given : {false, true}) {
    Stage stage;
    stage.x_m = -30e-6;
    stage.wait(2);
    for (const double t : {0.0, 5e-3, 10e-3, 15e-3}) stage.move_to(t), stage.wait(0.5);
    const Sequence found =
        stage.sequence(given ? std::vector<double>{0, 5e-3, 10e-3, 15e-3} : std::vector<double>{});
    ASSERT_EQ(found.points.size(), 4u);
    EXPECT_NEAR(found.points[0].point.position_m, 0, 1e-7);
    EXPECT_NEAR(found.points[0].target_m, 0, 1e-7);
  }
}

}  // namespace
}  // namespace mdof::algo
