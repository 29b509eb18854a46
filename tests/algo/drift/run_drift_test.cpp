#include "algo/drift/run_drift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/base/random.h"
#include "tests/algo/drift/drift_log.h"

namespace mdof::algo {
namespace {

// Largest deviation of δy from the true form and reversal, relative to the mean deviation.
double worst_deviation_m(const Log& log, const std::vector<MeasuredPoint>& points) {
  double mean = 0;
  std::vector<double> off;
  for (const MeasuredPoint& p : points) {
    off.push_back(p.errors.local[kDy] - log.form(p.target) -
                  p.point.direction * 0.5 * log.reversal(p.target));
    mean += off.back() / static_cast<double>(points.size());
  }
  double worst = 0;
  for (const double x : off) worst = std::max(worst, std::abs(x - mean));
  return worst;
}

TEST(RunDrift, FindsALinearDriftExactlyWithoutNoise) {
  Log log;
  log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
  const auto points = log.points();
  const DriftOfRun drift(points);
  EXPECT_EQ(drift.found().not_seen, "");
  EXPECT_DOUBLE_EQ(drift.found().length_s, log.length_s());
  EXPECT_EQ(drift.found().errors[kDy].order, 1);
  EXPECT_NEAR(drift.found().errors[kDy].change, 200e-9, 1e-15);
  EXPECT_NEAR(drift.found().errors[kDy].range, 200e-9, 1e-15);
  EXPECT_NEAR(drift.found().probes[3].change, 200e-9, 1e-15);
  for (const std::size_t k : {kDz, kEx, kEy, kEz})
    EXPECT_FALSE(drift.found().errors[k].significant());
  EXPECT_LT(worst_deviation_m(log, drift.without(points)), 1e-15);
  EXPECT_NEAR(worst_deviation_m(log, points), 100e-9, 1e-9);
}

// The noise of successive readings has a correlation of 0.6. A fit that assumes independent
// readings would report a drift for 144 of these 400 logs.
TEST(RunDrift, CorrelatedNoiseIsNoDrift) {
  int found = 0;
  constexpr int kSeeds = 400;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    Log log;
    log.noise_m = 0.1 * kNoise;
    log.seed = seed;
    Log white;
    white.noise_m = kNoise;
    white.seed = seed + 10'000;
    std::vector<double> slow;  // one value per visit, in intervals of 2 s
    for (const MeasuredPoint& p : white.points()) {
      const double fresh = p.errors.local[kDz] - white.form(p.target) -
                           p.point.direction * 0.5 * white.reversal(p.target);
      slow.push_back(slow.empty() ? fresh : 0.6 * slow.back() + 0.8 * fresh);
    }
    log.drift = [&](double t) { return slow[static_cast<std::size_t>(t / 2 + 0.5)]; };
    found += DriftOfRun(log.points()).found().errors[kDy].significant();
  }
  EXPECT_LE(found, kSeeds / 100);
}

TEST(RunDrift, UncertaintyMatchesTheScatter) {
  double square = 0, stated = 0;
  constexpr int kSeeds = 100;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Log log;
    log.noise_m = kNoise;
    log.seed = static_cast<std::uint32_t>(seed);
    log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
    const DriftOfRun drift(log.points());
    const SeriesDrift& of = drift.found().errors[kDy];
    ASSERT_GE(of.order, 1);
    square += (of.change - 200e-9) * (of.change - 200e-9) / kSeeds;
    stated += of.u_change * of.u_change / kSeeds;
  }
  // u contains courses that are not linear, which this drift does not have.
  EXPECT_GT(std::sqrt(stated / square), 1);
  EXPECT_LT(std::sqrt(stated / square), 2);
}

TEST(RunDrift, ALogWithoutDriftIsGivenNoneMoreOftenThanStated) {
  int errors = 0, probes = 0;
  constexpr int kSeeds = 1000;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Log log;
    log.noise_m = kNoise;
    log.seed = static_cast<std::uint32_t>(seed);
    const DriftOfRun drift(log.points());
    errors += drift.found().significant();
    for (const auto& p : drift.found().probes)
      if (p.significant()) {
        ++probes;
        break;
      }
  }
  EXPECT_LE(errors, 16);  // 10 are expected; 2 standard deviations are added
  EXPECT_LE(probes, 16);
}

TEST(RunDrift, AsOftenAsStatedOfTwoRuns) {
  int errors = 0;
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    Log log;
    log.runs = 2;
    log.noise_m = kNoise;
    log.seed = 5000 + seed;
    errors += DriftOfRun(log.points()).found().significant();
  }
  EXPECT_LE(errors, 10);
}

// Each drift changes by 200 nm; the noise is 3 nm. `left_m`: limit of the remaining error.
TEST(RunDrift, RemovesCurvedDriftsWithinLimits) {
  struct Kind {
    const char* name;
    std::function<double(double)> of;  // argument: elapsed fraction of the log
    double left_m;
  };
  const auto turns = [](double n) {
    return [n](double x) { return 100e-9 * std::sin(2 * M_PI * n * x); };
  };
  for (const Kind& kind :
       {Kind{"linear", [](double x) { return 200e-9 * x; }, 15e-9},
        Kind{"warm-up", [](double x) { return 200e-9 * (1 - std::exp(-4 * x)); }, 30e-9},
        Kind{"sine", turns(0.75), 30e-9}}) {
    Log log;
    log.runs = 4;
    log.noise_m = kNoise;
    log.drift = [&](double t) { return kind.of(t / log.length_s()); };
    const auto points = log.points();
    const DriftOfRun drift(points);
    EXPECT_GT(drift.found().errors[kDy].order, 0) << kind.name;
    EXPECT_FALSE(drift.found().errors[kDy].steps) << kind.name;
    const double before = worst_deviation_m(log, points),
                 after = worst_deviation_m(log, drift.without(points));
    EXPECT_GT(before, 90e-9) << kind.name;
    EXPECT_LT(after, kind.left_m) << kind.name;
  }
}

TEST(RunDrift, SingleRunCannotSeparateDriftFromForm) {
  Log log;
  log.runs = 1;
  log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
  const auto points = log.points();
  const DriftOfRun drift(points);
  EXPECT_NE(drift.found().not_seen.find("measure two runs"), std::string::npos);
  EXPECT_FALSE(drift.found().significant());
  EXPECT_EQ(drift.without(points)[20].errors.local, points[20].errors.local);
  ASSERT_EQ(drift.found().closures.size(), 1u);  // the difference contains the reversal
  EXPECT_FALSE(drift.found().closures[0].same_side);
  EXPECT_NEAR(drift.found().closures[0].change[kDy], 200e-9 - 80e-9, 1e-15);
}

TEST(RunDrift, ClosuresUseAVisitFromTheSameSide) {
  Log log;
  log.runs = 2;
  log.back_to_start = true;
  log.drift = [](double t) { return 1e-9 * t; };
  const auto closures = DriftOfRun(log.points()).found().closures;
  ASSERT_EQ(closures.size(), 2u);
  for (const Closure& c : closures) {
    EXPECT_TRUE(c.same_side);
    EXPECT_DOUBLE_EQ(c.after_s, 52);
    EXPECT_NEAR(c.change[kDy], 52e-9, 1e-15);
    EXPECT_NEAR(c.change[kDz], 0, 1e-15);
  }
}

// 78 stops in intervals of 2 s. Invalid points are ignored.
TEST(RunDrift, LengthIsFromFirstToLastValidPoint) {
  const Log log;
  EXPECT_NEAR(DriftOfRun(log.points()).found().length_s, 154, 1e-9);
  auto points = log.points();
  points.back().errors.valid = false;
  points.front().errors.valid = false;
  EXPECT_NEAR(DriftOfRun(points).found().length_s, 150, 1e-9);
}

TEST(RunDrift, DoesNotDependOnTheStartTime) {
  Log log;
  log.noise_m = kNoise;
  log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
  auto points = log.points();
  const RunDrift at_zero = DriftOfRun(points).found();
  for (MeasuredPoint& p : points) {
    p.point.begin_ns += 3'600'000'000'000;
    p.point.end_ns += 3'600'000'000'000;
  }
  const RunDrift later = DriftOfRun(points).found();
  EXPECT_NEAR(later.length_s, log.length_s(), 1e-9);
  ASSERT_EQ(later.closures.size(), at_zero.closures.size());
  EXPECT_NEAR(later.closures[0].after_s, at_zero.closures[0].after_s, 1e-9);
  EXPECT_NEAR(later.errors[kDy].change, at_zero.errors[kDy].change, 1e-13);
}

// Somebody touched the fixture between the runs. Steps from run to run look like a steady drift.
TEST(RunDrift, StepsBetweenRunsAreNotRemoved) {
  for (const int runs : {2, 3, 4}) {
    Log log;
    log.runs = runs;
    log.noise_m = kNoise;
    log.of_run = [](int run) { return 100e-9 * run; };
    const auto points = log.points();
    const DriftOfRun drift(points);
    EXPECT_TRUE(drift.found().errors[kDy].significant());
    EXPECT_TRUE(drift.found().errors[kDy].steps) << runs;
    EXPECT_FALSE(drift.found().removable());
    EXPECT_EQ(drift.without(points)[7].errors.local, points[7].errors.local);
  }
}

TEST(RunDrift, VaryingReversalIsNoDrift) {
  Log log;
  log.noise_m = kNoise;
  log.reversal = [](int target) { return 80e-9 + 20e-9 * target; };
  EXPECT_FALSE(DriftOfRun(log.points()).found().significant());
}

// Each pass has its own random shift, as on real machines.
TEST(RunDrift, RandomShiftsOfPassesAreNotTakenForADrift) {
  int removed = 0;
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    Log log;
    log.runs = 2 + static_cast<int>(seed % 4);
    log.noise_m = kNoise;
    log.seed = seed;
    const double length_s = log.length_s() / (2 * log.runs);
    log.drift = [&](double t) {
      const auto pass = static_cast<std::uint32_t>(t / (length_s + 0.5));
      return 4 * kNoise * gaussian(uniform(seed * 2654435761u, (pass + 1) * 2246822519u));
    };
    removed += DriftOfRun(log.points()).found().removable();
  }
  RecordProperty("removed_of_500", removed);
  EXPECT_LE(removed, 10);
}

TEST(RunDrift, DriftInOneDirectionMayBeSteps) {
  Log log;
  log.both_ways = false;
  log.noise_m = kNoise;
  log.drift = [&](double t) { return -200e-9 * t / log.length_s(); };
  const DriftOfRun drift(log.points());
  EXPECT_NEAR(drift.found().errors[kDy].change, -200e-9, 15e-9);
  EXPECT_TRUE(drift.found().errors[kDy].steps);
  EXPECT_FALSE(drift.found().removable());
}

TEST(RunDrift, UncertaintyGrowsFromTheStart) {
  Log log;
  log.noise_m = kNoise;
  log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
  const auto points = log.points();
  const DriftOfRun drift(points);
  const auto after = drift.without(points);
  const DriftOfRun again(after);
  EXPECT_FALSE(again.found().significant());
  EXPECT_TRUE(again.removal_shifts(after).empty());
  const auto shifts = drift.removal_shifts(points);
  const auto u_at = [&](std::size_t point, std::size_t error) {
    double square = 0;
    for (const auto& part : shifts) square += part[point][error] * part[point][error];
    return std::sqrt(square);
  };
  EXPECT_NEAR(u_at(0, kDy), 0, 1e-20);
  EXPECT_GT(u_at(after.size() - 1, kDy), 0.3 * kNoise);
  EXPECT_LT(u_at(after.size() - 1, kDy), 3 * kNoise);
  EXPECT_GT(u_at(after.size() / 2, kDy), 0);
  EXPECT_EQ(u_at(after.size() - 1, kDz), 0);  // no drift was removed from δz
  EXPECT_LT(drift.freedom(), 78 - 26 - 1);    // the white noise and the trend alone
  EXPECT_GT(drift.freedom(), 1);
  EXPECT_EQ(after.back().errors.covariance, points.back().errors.covariance);
}

TEST(RunDrift, PointsWithoutErrorsRemainUnchanged) {
  Log log;
  log.noise_m = kNoise;
  log.drift = [&](double t) { return 200e-9 * t / log.length_s(); };
  auto points = log.points();
  points[5].errors = AxisErrors();
  points[6].point.direction = 0;
  points[7].point.probe_m[2] = std::nan("");
  const DriftOfRun drift(points);
  EXPECT_TRUE(drift.found().removable());
  EXPECT_TRUE(drift.found().probes[3].significant());
  const auto after = drift.without(points);
  EXPECT_EQ(after[5].errors.local, points[5].errors.local);
  EXPECT_NE(after[6].errors.local, points[6].errors.local);  // a valid point
  EXPECT_NE(DriftOfRun({}).found().not_seen, "");
}

TEST(SeriesDrift, CriticalTMatchesTheTables) {
  EXPECT_NEAR(critical_t(0.01, 4), 4.604, 0.001);
  EXPECT_NEAR(critical_t(0.05, 10), 2.228, 0.001);
}

// One drift falls. The other rises to 101 nm and falls to -40 nm at the end.
TEST(RunDrift, RangeIsHighestMinusLowest) {
  Log log;
  log.noise_m = 0.1 * kNoise;
  log.drift = [&](double t) { return -200e-9 * t / log.length_s(); };
  SeriesDrift found = DriftOfRun(log.points()).found().errors[kDy];
  EXPECT_NEAR(found.range, 200e-9, 5e-9);
  EXPECT_NEAR(found.change, -200e-9, 5e-9);
  log.drift = [&](double t) {  // parabola 4 h x (1 - x), and -40 nm at the end
    const double x = t / log.length_s();
    return 480e-9 * x * (1 - x) - 40e-9 * x;
  };
  found = DriftOfRun(log.points()).found().errors[kDy];
  EXPECT_NEAR(found.range, 480e-9 * 0.25 * std::pow(1 - 4. / 48, 2) + 40e-9, 6e-9);
  EXPECT_NEAR(found.change, -40e-9, 5e-9);
  // Without a drift all results are 0.
  found = DriftOfRun(Log().points()).found().errors[kDz];
  EXPECT_EQ(found.order, 0);
  EXPECT_EQ(found.change, 0);
  EXPECT_EQ(found.u_change, 0);
  EXPECT_EQ(found.range, 0);
  EXPECT_FALSE(found.steps);
}

}  // namespace
}  // namespace mdof::algo
