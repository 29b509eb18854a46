#include "algo/plausibility/visit_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

using test::shown;

constexpr int kTargets = 13;
constexpr double kNoise = 20e-9, kStop_s = 2;

// Three runs there and back, five probes; `more`: what is added to probe E at each stop, m.
std::vector<MeasuredPoint> repeated_log(std::uint64_t seed, const std::function<double(int)>& more,
                                        int runs = 3) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<> normal;
  std::vector<MeasuredPoint> points;
  for (int n = 0; n < 2 * kTargets * runs; ++n) {
    MeasuredPoint& p = points.emplace_back();
    const int in_run = n % (2 * kTargets);
    p.run = 1 + n / (2 * kTargets);
    p.target = in_run < kTargets ? in_run + 1 : 2 * kTargets - in_run;
    p.point.position_m = p.target_m = 5e-3 * p.target;
    p.point.direction = in_run < kTargets ? 1 : -1;
    p.point.begin_ns = p.point.end_ns = static_cast<std::int64_t>(1e9 * kStop_s * n);
    for (int k = 0; k < 5; ++k) {
      p.point.probe_m.push_back(5e-6 * std::sin(p.target + k) + 80e-9 * p.point.direction +
                                kNoise * normal(engine) + (k == 4 ? more(n) : 0));
      p.point.probe_u_m.push_back(0.2 * kNoise);
      p.point.probe_sd_m.push_back(kNoise);
    }
  }
  return points;
}

double no_change(int) {
  return 0;
}

TEST(VisitStep, NamesTheProbeAndTheVisit) {
  const Rig rig = test::rig_x();
  for (const int at : {15, 26, 40, 70})  // in a run, between two, near the end
    for (const double size : {200e-9, -200e-9}) {
      const auto points = repeated_log(7, [=](int n) { return n >= at ? size : 0; });
      const auto steps = visit_steps(rig, points);
      ASSERT_EQ(steps.size(), 1U) << at;
      EXPECT_EQ(steps[0].probe, 4U);
      EXPECT_NEAR(static_cast<double>(steps[0].point), at, 1);
      EXPECT_NEAR(steps[0].size_m, size, 20e-9);
      EXPECT_NEAR(steps[0].sd_m, kNoise, 5e-9);
    }
  const auto said = repeat_notices(rig, repeated_log(7, [](int n) { return n >= 40 ? 2e-7 : 0; }));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].subject, "E");
  EXPECT_NEAR(test::number(said[0], "step_um"), 0.2, 0.1);
  EXPECT_NE(shown(said[0]).find(" run=2 target=12 approach=reverse"), std::string::npos);
}

TEST(VisitStep, ProbesThatStepTogetherAreOneNoticeEach) {
  auto points = repeated_log(9, [](int n) { return n >= 30 ? 300e-9 : 0; });
  for (std::size_t n = 30; n < points.size(); ++n) points[n].point.probe_m[1] -= 400e-9;
  const auto said = repeat_notices(test::rig_x(), points);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0].subject + said[1].subject, "BE");
  EXPECT_NEAR(test::number(said[0], "step_um"), -0.4, 0.1);
  EXPECT_NEAR(test::number(said[1], "step_um"), 0.3, 0.1);
}

TEST(VisitStep, WhatChangesSlowlyIsNone) {
  const Rig rig = test::rig_x();
  int found = 0, logs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 engine(1000 + seed);
    std::normal_distribution<> normal;
    std::vector<double> walk = {0}, lasting = {0}, passes;
    for (int n = 0; n < 2 * kTargets * 3; ++n) {
      walk.push_back(walk.back() + 2 * kNoise * normal(engine));
      lasting.push_back(0.82 * lasting.back() + 3 * kNoise * normal(engine));
      if (n % kTargets == 0) passes.push_back(4 * kNoise * normal(engine));
    }
    const double length = 2.0 * kTargets * 3;
    for (const std::function<double(int)>& of :
         {std::function<double(int)>(no_change),
          std::function<double(int)>([&](int n) { return walk[static_cast<std::size_t>(n)]; }),
          std::function<double(int)>([&](int n) { return lasting[static_cast<std::size_t>(n)]; }),
          std::function<double(int)>(
              [&](int n) { return passes[static_cast<std::size_t>(n / kTargets)]; }),
          std::function<double(int)>([=](int n) { return 600e-9 * n / length; }),
          std::function<double(int)>([=](int n) { return 600e-9 * std::exp(-3 * n / length); })}) {
      ++logs;
      found += !visit_steps(rig, repeated_log(seed, of)).empty();
    }
  }
  std::printf("steps found in %d of %d logs without one\n", found, logs);
  EXPECT_LE(found, logs / 100);
}

TEST(VisitStep, WhatTheDwellsFoundIsNotSaidAgain) {
  auto points = repeated_log(7, [](int n) { return n >= 40 ? 200e-9 : 0; });
  points[40].point.flags = {{Flag::step, "E"}};
  EXPECT_TRUE(visit_steps(test::rig_x(), points).empty());
  EXPECT_TRUE(visit_steps(test::rig_x(), {}).empty());
  // One run visits each place once.
  EXPECT_TRUE(visit_steps(test::rig_x(), repeated_log(
                                             7, [](int n) { return n >= 15 ? 2e-7 : 0; }, 1))
                  .empty());
}

TEST(VisitStep, ASecondCopyOfTheSameRun) {
  auto points = repeated_log(3, no_change, 1);
  const auto once = points;
  for (MeasuredPoint p : once) {
    p.run = 2;
    p.point.begin_ns += 100'000'000'000;
    points.push_back(p);
  }
  const auto said = repeat_notices(test::rig_x(), points);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(shown(said[0]), "readings_copied copies=26 points=52");
  EXPECT_TRUE(repeat_notices(test::rig_x(), repeated_log(3, no_change)).empty());
  for (MeasuredPoint& p : points) p.point.probe_sd_m.assign(5, 0);  // without noise they repeat
  EXPECT_TRUE(repeat_notices(test::rig_x(), points).empty());
}

// A single visit cannot show slow noise, and that keeps no table from a controller.
TEST(VisitStep, TargetsThatWereVisitedOnceAreSaid) {
  SyntheticRun synthetic{.rig = test::rig_x(), .runs = 1};
  const auto said = repeat_notices(synthetic.rig, synthetic.measure().points);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].code, NoticeCode::visited_once);
  EXPECT_EQ(said[0].severity, Severity::information);
  synthetic.runs = 2;
  EXPECT_TRUE(repeat_notices(synthetic.rig, synthetic.measure().points).empty());
}

// Six copies and a tenth of all points are enough, less of either is not.
TEST(VisitStep, CopiesOfASixthStopAndATenthAreSaid) {
  const auto said = [](std::size_t copies, std::size_t all) {
    auto points = repeated_log(3, no_change);
    points.resize(all);
    // Each of the second run is one of the first again.
    for (std::size_t i = 0; i < copies; ++i) points[26 + i].point = points[i].point;
    return repeat_notices(test::rig_x(), points);
  };
  ASSERT_EQ(said(6, 60).size(), 1u);
  EXPECT_EQ(shown(said(6, 60)[0]), "readings_copied copies=6 points=60");
  EXPECT_TRUE(said(6, 61).empty());
  EXPECT_TRUE(said(5, 40).empty());
  EXPECT_EQ(said(6, 40).size(), 1u);
}

}  // namespace
}  // namespace mdof::algo
