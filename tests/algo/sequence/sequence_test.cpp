// Tests the recognition of measuring cycles from the stops of an axis.
#include "algo/sequence/sequence.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>

#include "tests/algo/measured_machine.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

Sequence check(const Machine& machine, const SequenceOptions& options = {}) {
  const Sequence s = recognise_sequence(machine.points(), options);
  EXPECT_EQ(s.points.size(), machine.truth.size());
  for (std::size_t i = 0; i < std::min(s.points.size(), machine.truth.size()); ++i) {
    const auto& p = s.points[i];
    const auto& t = machine.truth[i];
    EXPECT_EQ(std::tie(p.target, p.run, p.point.direction), std::tie(t.target, t.run, t.direction))
        << "visit " << i;
    EXPECT_LT(std::abs(p.target_m - machine.at(t.target)), 1e-6);
  }
  return s;
}

TEST(Cycle, RecognisesStandardCyclesOfSixtyRandomPlans) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 rng(seed);
    const auto uniform = [&](double a, double b) {
      return std::uniform_real_distribution<>(a, b)(rng);
    };
    Machine m(seed);
    const int n = std::uniform_int_distribution<>(3, 15)(rng);
    const double interval_m = uniform(3e-3, 10e-3), jitter = uniform(0, 0.25);
    m.targets.clear();
    for (int i = 0; i < n; ++i) m.targets.push_back(interval_m * (i + jitter * uniform(-1, 1)));
    m.x_m = m.targets[0] - 2e-3;
    m.standard(std::uniform_int_distribution<>(1, 5)(rng));
    const Sequence s = check(m);
    EXPECT_EQ(s.cycle, Cycle::standard) << seed;
    EXPECT_EQ(test::shown(s.notices), "") << seed;
  }
}

TEST(Cycle, RecognisesAStandardCycleInOneDirection) {
  Machine m;
  for (int run = 1; run <= 3; ++run) m.forward(run), m.beyond(1, -1);
  EXPECT_EQ(check(m).cycle, Cycle::standard);
}

TEST(Cycle, RecognisesAStandardCycleThatBeginsInReverse) {
  Machine m;
  m.x_m = 32e-3;
  for (int run = 1; run <= 2; ++run) {
    m.reverse(run), m.beyond(1, -1);
    m.forward(run), m.beyond(m.count(), 1);
  }
  EXPECT_EQ(check(m).cycle, Cycle::standard);
}

TEST(Cycle, RecognisesAPilgrimCycle) {
  for (const int runs : {1, 2, 5}) {
    Machine m;
    for (int t = 1; t <= m.count(); ++t) m.oscillate(t, 1, runs);
    const Sequence s = check(m);
    EXPECT_EQ(s.cycle, Cycle::pilgrim);
    EXPECT_EQ(s.runs, runs);
    EXPECT_EQ(s.targets, m.count());
    EXPECT_EQ(test::shown(s.notices), "");
  }
}

TEST(Cycle, RecognisesAPilgrimCycleInOneDirection) {
  Machine m;
  for (int t = 1; t <= m.count(); ++t) {
    for (int run = 1; run <= 3; ++run) m.beyond(t, -1), m.visit(t, run, 1);
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.cycle, Cycle::pilgrim);
  EXPECT_EQ(test::shown(s.notices), "");
}

TEST(Cycle, RecognisesAQuasiPilgrimCycleOverAllTargets) {
  Machine m;
  for (int run = 1; run <= 3; ++run) {
    for (int t = 1; t <= m.count(); ++t) m.oscillate(t, run, 1);
  }
  EXPECT_EQ(check(m).cycle, Cycle::quasi_pilgrim);
}

// Two targets are visited three times in both directions, then the next two targets, and so on.
TEST(Cycle, RecognisesAQuasiPilgrimCycleOverGroups) {
  Machine m;
  m.targets = {0, 5e-3, 10e-3, 15e-3, 20e-3, 25e-3, 30e-3, 35e-3};
  for (int first = 1; first < m.count(); first += 2) {
    for (int run = 1; run <= 3; ++run) {
      m.beyond(first, -1);
      m.visit(first, run, 1), m.visit(first + 1, run, 1);
      m.beyond(first + 1, 1);
      m.visit(first + 1, run, -1), m.visit(first, run, -1);
    }
  }
  EXPECT_EQ(check(m).cycle, Cycle::quasi_pilgrim);
}

TEST(Cycle, RecognisesAPendulumCycle) {
  for (const int runs : {1, 3}) {
    Machine m;
    m.visit(1, 1, 1);
    for (int run = 1; run <= runs; ++run) {
      for (int t = 2; t <= m.count(); ++t) m.visit(t, run, 1);
      for (int t = m.count() - 1; t >= 1; --t) m.visit(t, run, -1);
    }
    const Sequence s = check(m);
    EXPECT_EQ(s.cycle, Cycle::pendulum);
    EXPECT_EQ(s.runs, runs);
    EXPECT_TRUE(s.left_out.empty());
  }
}

TEST(Cycle, ReportsAnUnknownCycle) {
  Machine m;
  std::map<std::pair<int, int>, int> visits;
  for (const int t : {4, 1, 6, 2, 7, 3, 5, 1, 7, 4, 2, 6, 3, 5, 7, 2, 5, 1, 4, 6, 3}) {
    const int direction = m.at(t) > m.x_m ? 1 : -1;
    m.visit(t, ++visits[{t, direction}], direction);
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.cycle, Cycle::none);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::cycle_unknown)) << test::shown(s.notices);
}

TEST(Cycle, OvershootOfEveryStopIsNoTurn) {
  for (const double by_m : {40e-6, 100e-6, 200e-6}) {
    Machine m;
    m.speed_m_s = 4e-3;
    for (int run = 1; run <= 3; ++run) {
      for (int t = 1; t <= m.count(); ++t) {
        m.stop_overshot(m.at(t), by_m);
        m.truth.push_back({t, run, 1});
      }
      m.beyond(m.count(), 1);
      for (int t = m.count(); t >= 1; --t) {
        m.stop_overshot(m.at(t), by_m);
        m.truth.push_back({t, run, -1});
      }
      m.beyond(1, -1);
    }
    const Sequence s = check(m);
    EXPECT_EQ(s.runs, 3);
    EXPECT_EQ(s.cycle, Cycle::standard);
    // An overshoot is reported only if it looks like an approach from the other side.
    EXPECT_EQ(test::has(s.notices, NoticeCode::stop_overshot), by_m > 50e-6) << by_m;
    for (const Notice& told : s.notices) {
      if (told.code != NoticeCode::stop_overshot) continue;
      EXPECT_NEAR(std::get<double>(*value(told, "most_mm")), by_m * 1e3, 0.01);
    }
  }
}

// The axis moves beyond each target, so it approaches all targets from above.
TEST(Cycle, TargetsMayBeApproachedFromTheOtherSide) {
  Machine m;
  for (int run = 1; run <= 2; ++run) {
    for (int t = 1; t <= m.count(); ++t) {
      m.stop_overshot(m.at(t), 0.5e-3);
      m.truth.push_back({t, run, -1});
    }
    m.beyond(1, -1);
  }
  EXPECT_EQ(check(m).runs, 2);
}

TEST(Cycle, LeavesOutPausesBetweenTargets) {
  Machine m;
  for (int run = 1; run <= 2; ++run) {
    for (int t = 1; t <= m.count(); ++t) {
      m.visit(t, run, 1);
      if (run == 1 && t < m.count()) m.stop(m.at(t) + 1.3e-3 + 0.3e-3 * t);
    }
    m.beyond(m.count(), 1);
    m.reverse(run);
    m.beyond(1, -1);
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.left_out.size(), 6u);
  EXPECT_EQ(s.cycle, Cycle::standard);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_between_targets)) << test::shown(s.notices);
}

TEST(Cycle, LeavesOutTurningPoints) {
  Machine m;
  for (int run = 1; run <= 3; ++run) {
    m.forward(run);
    m.stop(m.at(m.count()) + kOverrun_m);
    m.reverse(run);
    m.stop(m.at(1) - kOverrun_m);
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.left_out.size(), 6u);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_beyond_targets)) << test::shown(s.notices);
}

TEST(Cycle, LeavesOutTurningPointsOfAPilgrimCycle) {
  Machine m;
  for (int t = 1; t <= m.count(); ++t) {
    for (int run = 1; run <= 3; ++run) {
      m.stop(m.at(t) - kOverrun_m);
      m.visit(t, run, 1);
      m.stop(m.at(t) + kOverrun_m);
      m.visit(t, run, -1);
    }
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.cycle, Cycle::pilgrim);
  EXPECT_EQ(s.left_out.size(), 42u);
}

TEST(Cycle, ParkedStartIsNoTarget) {
  for (const double parked_m : {-5e-3, -1e-3, -20e-3, 12e-3, 35e-3}) {
    for (const int runs : {1, 3}) {
      Machine m;
      m.x_m = parked_m;
      m.wait(2);
      m.beyond(1, -1);
      m.standard(runs);
      const Sequence s = check(m);
      EXPECT_EQ(s.targets, 7) << parked_m;
      ASSERT_EQ(s.left_out.size(), 1u) << parked_m;
      EXPECT_NEAR(s.left_out[0].position_m, parked_m, 1e-6);
      EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_parked_at_start)) << test::shown(s.notices);
    }
  }
}

TEST(Cycle, ParkedStartAtATargetIsNoVisit) {
  Machine m;
  m.x_m = m.at(1);
  m.wait(2);
  m.beyond(1, -1);
  m.standard(2);
  const Sequence s = check(m);
  ASSERT_EQ(s.left_out.size(), 1u);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_parked_at_start)) << test::shown(s.notices);
}

TEST(Cycle, KeepsAStartAtTheFirstTarget) {
  for (const int runs : {1, 2}) {
    Machine m;
    m.x_m = m.at(1);
    m.standard(runs);
    const Sequence s = check(m);
    EXPECT_TRUE(s.left_out.empty());
  }
}

TEST(Cycle, MissedStopShiftsNoRun) {
  for (std::size_t missed = 0; missed < 42; ++missed) {
    Machine m;
    m.standard(3);
    auto points = m.points();
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(missed));
    const Sequence s = recognise_sequence(points, {});
    ASSERT_EQ(s.points.size(), 41u);
    for (std::size_t i = 0; i < 41; ++i) {
      const Truth& t = m.truth[i + (i >= missed)];
      const auto& p = s.points[i];
      EXPECT_EQ(std::tie(p.target, p.run, p.point.direction),
                std::tie(t.target, t.run, t.direction))
          << missed << " " << i;
    }
  }
}

TEST(Cycle, ReturnToATargetIsASecondVisitInTheRun) {
  Machine m;
  m.forward(1);
  m.beyond(m.count(), 1);
  m.reverse(1);
  m.beyond(1, -1);
  for (int t = 1; t <= m.count(); ++t) {
    m.visit(t, 2, 1);
    if (t != 4) continue;
    m.beyond(4, -1);
    m.visit(4, 2, 1);
  }
  m.beyond(m.count(), 1);
  m.reverse(2);
  const Sequence s = check(m);
  EXPECT_EQ(s.runs, 2);
  EXPECT_EQ(s.cycle, Cycle::standard);
}

TEST(Cycle, ReturnByTwoTargetsIsNoNewRun) {
  Machine m;
  m.targets = {0, 5e-3, 10e-3, 15e-3, 20e-3, 25e-3, 30e-3, 35e-3};
  for (int run = 1; run <= 3; ++run) {
    for (int t = 1; t <= m.count(); ++t) {
      m.visit(t, run, 1);
      if (run != 2 || t != 6) continue;
      m.visit(5, 2, -1), m.visit(4, 2, -1);
      m.visit(5, 2, 1), m.visit(6, 2, 1);
    }
    m.beyond(m.count(), 1);
    m.reverse(run);
    m.beyond(1, -1);
  }
  const Sequence s = check(m);
  EXPECT_EQ(s.runs, 3);
  EXPECT_EQ(s.cycle, Cycle::standard);
}

TEST(Cycle, GivenTargetsLeaveOutOtherStops) {
  Machine m;
  m.x_m = -20e-3;
  m.wait(1);
  m.standard(2);
  SequenceOptions options;
  options.targets_m = m.targets;
  Sequence s = check(m, options);
  EXPECT_EQ(s.left_out.size(), 1u);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_parked_at_start)) << test::shown(s.notices);
  EXPECT_FALSE(test::has(s.notices, NoticeCode::stop_near_no_target));
  // A later stop beside the targets, which is no parked start, belongs to no target.
  m.move_to(-20e-3);
  m.wait(1);
  s = check(m, options);
  EXPECT_EQ(s.left_out.size(), 2u);
  EXPECT_TRUE(test::has(s.notices, NoticeCode::stop_near_no_target)) << test::shown(s.notices);
}

// In a live run, points are displayed and stored at once. The labels of points in a regular cycle
// must not change later.
TEST(Cycle, LabelsStayWhenPointsAreAdded) {
  Machine m;
  m.standard(3);
  const auto points = m.points();
  SequenceOptions options;
  options.targets_m = m.targets;
  for (std::size_t n = 1; n <= points.size(); ++n) {
    const Sequence s = recognise_sequence(
        {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n)}, options);
    ASSERT_EQ(s.points.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(std::tie(s.points[i].target, s.points[i].run),
                std::tie(m.truth[i].target, m.truth[i].run))
          << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace mdof::algo
