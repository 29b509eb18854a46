#include "algo/plausibility/visit_step.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

using test::shown;

constexpr int kTargets = 13;
constexpr double kNoise = 20e-9, kStop_s = 2;

// Points of `runs` runs in both directions with five probes. `more`: change of the reading of probe
// E at stop n, m.
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

TEST(VisitStep, ReportsProbeAndVisit) {
  const Rig rig = test::rig_x();
  for (const int at : {15, 26, 40, 70})  // within a run, between two runs, near the end
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

// In a run in motion, a visit is a bin. If the probe steps in the middle of a bin, the u of this
// bin is about as large as the step.
TEST(VisitStep, IsFoundWithinAVisit) {
  const Rig rig = test::rig_x();
  for (const int at : {15, 40, 70}) {
    auto points = repeated_log(7, [=](int n) { return n > at ? 300e-9 : n == at ? 150e-9 : 0.0; });
    points[static_cast<std::size_t>(at)].point.probe_u_m[4] = 120e-9;
    const auto steps = visit_steps(rig, points);
    ASSERT_EQ(steps.size(), 1U) << at;
    EXPECT_EQ(steps[0].probe, 4U);
    EXPECT_NEAR(static_cast<double>(steps[0].point), at, 1);
    EXPECT_NEAR(steps[0].size_m, 300e-9, 20e-9);
  }
}

TEST(VisitStep, ProbesThatStepTogetherHaveOneNoticeEach) {
  auto points = repeated_log(9, [](int n) { return n >= 30 ? 300e-9 : 0; });
  for (std::size_t n = 30; n < points.size(); ++n) points[n].point.probe_m[1] -= 400e-9;
  const auto said = repeat_notices(test::rig_x(), points);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0].subject + said[1].subject, "BE");
  EXPECT_NEAR(test::number(said[0], "step_um"), -0.4, 0.1);
  EXPECT_NEAR(test::number(said[1], "step_um"), 0.3, 0.1);
}

TEST(VisitStep, SlowChangesAreNoStep) {
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

TEST(VisitStep, DoesNotRepeatStepsFoundInDwells) {
  auto points = repeated_log(7, [](int n) { return n >= 40 ? 200e-9 : 0; });
  points[40].point.flags = {{Flag::step, "E"}};
  EXPECT_TRUE(visit_steps(test::rig_x(), points).empty());
  EXPECT_TRUE(visit_steps(test::rig_x(), {}).empty());
  // A single run visits each target and direction once.
  EXPECT_TRUE(visit_steps(test::rig_x(), repeated_log(
                                             7, [](int n) { return n >= 15 ? 2e-7 : 0; }, 1))
                  .empty());
}

TEST(VisitStep, ReportsASecondCopyOfARun) {
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
  // Points without noise may be equal.
  for (MeasuredPoint& p : points) p.point.probe_sd_m.assign(5, 0);
  EXPECT_TRUE(repeat_notices(test::rig_x(), points).empty());
}

// The blocks of the second copy begin at other scans, so the means of its stops differ.
TEST(VisitStep, ReportsACopyWithShiftedDwells) {
  auto points = repeated_log(3, no_change, 1);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].point.scan_fingerprint = i + 1;
  const auto once = points;
  for (MeasuredPoint p : once) {
    p.run = 2;
    for (double& reading : p.point.probe_m) reading += 1e-10;
    points.push_back(p);
  }
  const auto said = repeat_notices(test::rig_x(), points);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(shown(said[0]), "readings_copied copies=26 points=52");
  for (std::size_t i = 26; i < 52; ++i) points[i].point.scan_fingerprint = i + 1;
  EXPECT_TRUE(repeat_notices(test::rig_x(), points).empty());
}

// A single visit does not show slow noise. The notice does not prevent a table.
TEST(VisitStep, ReportsTargetsVisitedOnce) {
  SyntheticRun synthetic{.rig = test::rig_x(), .runs = 1};
  const auto said = repeat_notices(synthetic.rig, synthetic.measure().points);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].code, NoticeCode::visited_once);
  EXPECT_EQ(said[0].severity, Severity::information);
  synthetic.runs = 2;
  EXPECT_TRUE(repeat_notices(synthetic.rig, synthetic.measure().points).empty());
}

// Copies are reported if at least six points and at least a tenth of all points are copies.
TEST(VisitStep, ReportsCopiesFromSixPointsAndATenthOn) {
  const auto said = [](std::size_t copies, std::size_t all) {
    auto points = repeated_log(3, no_change);
    points.resize(all);
    // Points of the second run become copies of points of the first run.
    for (std::size_t i = 0; i < copies; ++i) points[26 + i].point = points[i].point;
    return repeat_notices(test::rig_x(), points);
  };
  ASSERT_EQ(said(6, 60).size(), 1u);
  EXPECT_EQ(shown(said(6, 60)[0]), "readings_copied copies=6 points=60");
  EXPECT_TRUE(said(6, 61).empty());
  EXPECT_TRUE(said(5, 40).empty());
  EXPECT_EQ(said(6, 40).size(), 1u);
}

// Visits with a reading of one probe, grouped by target and direction.
struct PlacesOfProbe {
  std::vector<const MeasuredPoint*> visits;
  std::vector<std::vector<std::size_t>> places;

  PlacesOfProbe(const std::vector<MeasuredPoint>& points, std::size_t probe) {
    std::map<std::pair<int, int>, std::vector<std::size_t>> found;
    for (const MeasuredPoint& p : points) {
      if (p.point.direction == 0 || !std::isfinite(p.point.probe_m[probe])) continue;
      found[{p.target, p.point.direction}].push_back(visits.size());
      visits.push_back(&p);
    }
    for (const auto& [name, of] : found) places.push_back(of);
  }
  Eigen::VectorXd without_place_means(Eigen::VectorXd x) const {
    for (const auto& of : places) {
      double mean = 0;
      for (const std::size_t i : of)
        mean += x[static_cast<Eigen::Index>(i)] / static_cast<double>(of.size());
      for (const std::size_t i : of) x[static_cast<Eigen::Index>(i)] -= mean;
    }
    return x;
  }
};

// Fits each possible step separately. The smooth change is fitted by powers of the time.
std::vector<VisitStep> exhaustive_steps(const std::vector<MeasuredPoint>& points) {
  std::vector<VisitStep> steps;
  for (std::size_t k = 0; k < 5; ++k) {
    const PlacesOfProbe of(points, k);
    const auto n = static_cast<Eigen::Index>(of.visits.size());
    const double freedom = static_cast<double>(n) - static_cast<double>(of.places.size()) - 2;
    if (freedom < 4) continue;
    Eigen::VectorXd y(n), time(n), best = Eigen::VectorXd::Zero(n);
    std::vector<double> all_u;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Point& p = of.visits[static_cast<std::size_t>(i)]->point;
      y[i] = p.probe_m[k];
      time[i] = 1e-9 * static_cast<double>(p.begin_ns);
      all_u.push_back(p.probe_u_m[k]);
    }
    std::sort(all_u.begin(), all_u.end());
    const double u = std::max(1e-9 / 6, all_u[all_u.size() / 2]);
    y = of.without_place_means(y);
    double least = y.squaredNorm(), size = 0;
    Eigen::Index at = 0;
    for (Eigen::Index i = 1; i < n; ++i) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
      step.tail(n - i).setOnes();
      step = of.without_place_means(step);
      if (step.squaredNorm() < 2 - 1e-9) continue;
      const double fitted = step.dot(y) / step.squaredNorm();
      const double left = (y - fitted * step).squaredNorm();
      if (left < least) least = left, size = fitted, at = i;
    }
    const double sd = std::max(std::sqrt(least / freedom), u);
    if (at == 0 || std::abs(size) < 6 * sd) continue;
    Eigen::MatrixXd powers(n, 6);
    const Eigen::ArrayXd x = (time.array() - time[0]) / (time[n - 1] - time[0]) - 0.5;
    for (int order = 1; order <= 6; ++order)
      powers.col(order - 1) = of.without_place_means(x.pow(order));
    const Eigen::VectorXd fit = powers.colPivHouseholderQr().solve(y);
    const double smooth = (y - powers * fit).norm() / std::sqrt(freedom);
    if (freedom * std::log(smooth / sd) >= 10)
      steps.push_back(
          {k, static_cast<std::size_t>(of.visits[static_cast<std::size_t>(at)] - points.data()),
           size, sd});
  }
  return steps;
}

// The logs have irregular times, stops without approach or reading, few targets, and steps from
// small to large. The result must equal the exhaustive fit.
TEST(VisitStep, MatchesTheExhaustiveFit) {
  const Rig rig = test::rig_x();
  std::size_t found = 0, logs = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<> uniform;
    const int at = 5 + static_cast<int>(60 * uniform(engine)),
              runs = 1 + static_cast<int>(seed % 3);
    const double size = 900e-9 * (uniform(engine) - 0.5);
    auto points = repeated_log(
        seed, [&](int n) { return n >= at ? size : 0; }, runs + 1);
    std::vector<MeasuredPoint> some;
    double time_s = 5;
    for (MeasuredPoint& p : points) {
      p.point.begin_ns = static_cast<std::int64_t>(1e9 * (time_s += 1 + 3 * uniform(engine)));
      if (p.target > 2 + static_cast<int>(seed % 5) * 3) continue;
      if (uniform(engine) < 0.05) p.point.direction = 0;
      if (uniform(engine) < 0.05) p.point.probe_m[4] = std::nan("");
      if (seed % 7 == 0 && uniform(engine) < 0.2) p.point.probe_u_m[4] = 40e-9;
      p.point.probe_m[2] += some.size() > 9 ? -size : 0;
      some.push_back(p);
    }
    const auto steps = visit_steps(rig, some), expected = exhaustive_steps(some);
    ASSERT_EQ(steps.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i].probe, expected[i].probe) << seed;
      EXPECT_EQ(steps[i].point, expected[i].point) << seed;
      EXPECT_NEAR(steps[i].size_m, expected[i].size_m, 1e-6 * std::abs(size)) << seed;
      EXPECT_NEAR(steps[i].sd_m, expected[i].sd_m, 1e-6 * expected[i].sd_m) << seed;
    }
    found += steps.size(), ++logs;
  }
  EXPECT_GT(found, logs / 3);
  EXPECT_LT(found, 2 * logs);
}

// `before` and `after` are the numbers of visits of a place before and after the step. A step is
// accepted if before · after / all visits, summed over the places, is at least 2. After the first
// visit, each of three places with four visits contributes 3/4, each of two places with eight
// visits 7/8.
TEST(VisitStep, NeedsFourPlacesOrMoreVisits) {
  const auto found = [](int targets, int visits, int before, double u_m) {
    std::vector<MeasuredPoint> points;
    for (int v = 0; v < visits; ++v)
      for (int t = 1; t <= targets; ++t) {
        MeasuredPoint& p = points.emplace_back();
        p.target = t;
        p.point.direction = 1;
        p.point.begin_ns = 1'000'000'000 * static_cast<std::int64_t>(points.size());
        p.point.probe_m.assign(5, 0);
        p.point.probe_u_m.assign(5, u_m);
        p.point.probe_m[1] = 1e-6 * t + (v >= before ? 100e-9 : 0);
      }
    return visit_steps(test::rig_x(), points);
  };
  ASSERT_EQ(found(4, 4, 2, 0).size(), 1u);
  EXPECT_EQ(found(4, 4, 2, 0)[0].point, 8u);
  EXPECT_NEAR(found(4, 4, 2, 0)[0].size_m, 100e-9, 1e-15);
  EXPECT_NEAR(found(4, 4, 2, 0)[0].sd_m, 1e-9 / 6,
              1e-15);  // the smallest sd that is accepted if there is no noise
  EXPECT_NEAR(found(4, 4, 2, 1e-9)[0].sd_m, 1e-9, 1e-15);
  EXPECT_EQ(found(3, 4, 1, 0).size(), 1u);
  EXPECT_TRUE(found(2, 8, 1, 0).empty());
  // A step below six times u is not reported.
  EXPECT_TRUE(found(4, 4, 2, 16.7e-9).empty());
}

TEST(VisitStep, CopiesNeedEqualPositionAndNoise) {
  const auto said = [](const std::function<void(MeasuredPoint&)>& change) {
    auto points = repeated_log(3, no_change, 2);
    for (std::size_t i = 26; i < points.size(); ++i) {
      points[i].point = points[i - 26].point;
      change(points[i]);
    }
    return repeat_notices(test::rig_x(), points).size();
  };
  EXPECT_EQ(said([](MeasuredPoint&) {}), 1u);
  EXPECT_EQ(said([](MeasuredPoint& p) { p.point.position_m += 1e-9; }), 0u);
  EXPECT_EQ(said([](MeasuredPoint& p) { p.point.probe_m[2] += 1e-12; }), 0u);
  EXPECT_EQ(said([](MeasuredPoint& p) { p.target = 14 - p.target; }), 0u);
  // Only probe A has noise.
  auto points = repeated_log(3, no_change, 2);
  for (std::size_t i = 0; i < 26; ++i) points[i].point.probe_sd_m = {1e-9, 0, 0, 0, 0};
  for (std::size_t i = 26; i < points.size(); ++i) points[i].point = points[i - 26].point;
  EXPECT_TRUE(repeat_notices(test::rig_x(), points).empty());
  for (MeasuredPoint& p : points) p.point.probe_sd_m.clear();
  EXPECT_TRUE(repeat_notices(test::rig_x(), points).empty());
}

// A log of half a second is long enough. Visits at the same time have no order, so they show no
// change.
TEST(VisitStep, NeedsDifferentTimes) {
  auto points = repeated_log(7, [](int n) { return n >= 40 ? 200e-9 : 0; });
  for (MeasuredPoint& p : points) p.point.begin_ns /= 400;
  ASSERT_EQ(visit_steps(test::rig_x(), points).size(), 1U);
  for (MeasuredPoint& p : points) p.point.begin_ns = 5;
  EXPECT_TRUE(visit_steps(test::rig_x(), points).empty());
}

// A step of five times the noise is not reported, for any number of visits.
TEST(VisitStep, IgnoresStepsBelowSixTimesTheNoise) {
  const Rig rig = test::rig_x();
  EXPECT_TRUE(visit_steps(rig, repeated_log(
                                   7, [](int n) { return n >= 100 ? 95e-9 : 0; }, 8))
                  .empty());
  EXPECT_EQ(visit_steps(rig, repeated_log(
                                 7, [](int n) { return n >= 100 ? 140e-9 : 0; }, 8))
                .size(),
            1U);
  const auto forward =
      repeat_notices(rig, repeated_log(7, [](int n) { return n >= 58 ? 3e-7 : 0; }));
  ASSERT_EQ(forward.size(), 1U);
  EXPECT_NE(shown(forward[0]).find("approach=forward"), std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
