// A recursion draws correlated noise for each visit. The tests count how often the stated intervals
// contain the true values. Set MDOF_COVERAGE_RUNS=1000 to calculate figures for publication.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/coverage.h"
#include "algo/uncertainty/statistics/correlated_noise.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

struct CorrelatedCoverage {
  double slope_percent = 0, straightness_percent = 0;
  double U_by_spread = 0;  // mean U over 1.96 standard deviations of the slope error
};

// `correlation`: correlation time τ, in intervals between visits; 0: white noise. The error EYX of
// the axis is a wave of 2 µm without a slope.
CorrelatedCoverage correlated_coverage(int runs, double correlation, double tilt_rad,
                                       std::uint64_t seed) {
  const Rig rig = test::rig_x_with("", "");
  std::mt19937_64 engine(test::coverage_seed(seed));
  std::normal_distribution<> normal(0, 20e-9);
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = runs};
  synthetic.truth = [](double d) { return Errors5{1e-6 * std::sin(150 * d), 0, 0, 0, 0}; };
  const Figure slope = slope_figure(Axis::x, 0), straightness = straightness_figure(Axis::x, 0);
  const RunBudgets exact(rig, synthetic.measure());
  const double kept = correlation > 0 ? std::exp(-1 / correlation) : 0;
  const int n = test::coverage_runs(30);
  int slopes = 0, straight = 0;
  double U = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    std::array<double, 5> state{};
    for (double& x : state) x = normal(engine);
    std::vector<double> tilt;  // tilt of each run
    for (int r = 0; r < runs; ++r) tilt.push_back(tilt_rad / 20e-9 * normal(engine));
    synthetic.added = [&](std::size_t k, double d, double, double time_s) {
      const double of_run = tilt[static_cast<std::size_t>((time_s - 5) / 180)] * d;
      return (k == 3 || k == 4 ? of_run : 0) +
             (state[k] = kept * state[k] + std::sqrt(1 - kept * kept) * normal(engine));
    };
    const RunBudgets budgets(rig, synthetic.measure());
    const Budget s = budgets.of(slope), f = budgets.of(straightness);
    const double error = s.value - slope.of(exact.means());
    slopes += std::abs(error) <= s.U;
    straight += std::abs(f.value - straightness.of(exact.means())) <= f.U;
    U += s.U / n;
    square += error * error / n;
  }
  return {100.0 * slopes / n, 100.0 * straight / n, U / 1.96 / std::sqrt(square)};
}

// Expects at least `percent`, less three standard errors.
void expect_coverage(const CorrelatedCoverage& c, double percent) {
  const double three_sd = 65 / std::sqrt(test::coverage_runs(30));
  std::printf("slope %.1f %%, straightness %.1f %%, U/spread %.2f\n", c.slope_percent,
              c.straightness_percent, c.U_by_spread);
  EXPECT_GT(c.slope_percent, percent - three_sd);
  EXPECT_GT(c.straightness_percent, percent - three_sd);
}

TEST(CorrelatedNoise, IntervalsOfRunsHoldTheTruth) {
  for (const int runs : {3, 5})
    for (const double correlation : {0.0, 1.0, 4.0, 16.0}) {
      std::printf("%d runs, tau %g visits: ", runs, correlation);
      expect_coverage(correlated_coverage(runs, correlation, 0, 17), 95);
    }
}

// In three runs, a tilt of the runs that is as large as the noise is often not visible: 88 % of the
// intervals of 1,000 logs contain the truth instead of 95 %.
TEST(CorrelatedNoise, IntervalsOfRunsThatTiltMayBeTooShort) {
  for (const int runs : {3, 5})
    for (const double tilt_rad : {0.25e-6, 1e-6, 4e-6}) {
      std::printf("%d runs, tilt %g rad: ", runs, tilt_rad);
      expect_coverage(correlated_coverage(runs, 0, tilt_rad, 18), 89);
    }
}

// Three runs in both directions over nine targets, with one visit per second.
constexpr std::size_t kTargetsOfLog = 9, kPassesOfLog = 6;

struct Log {
  std::vector<NoisyVisit> visits;
  double slope = 0;   // slope over the target number, by least squares of the means
  double square = 0;  // sum of the squared residuals
};

double slope_weight(std::size_t target) {
  return (static_cast<double>(target) - 4) / 60;  // Σ (i - 4)² = 60
}

// `correlation`: correlation of consecutive visits. No visit is missing, so the residuals are
// calculated directly: the means of the target and of the pass are subtracted.
Log log_of(double correlation, double level, std::mt19937_64& engine) {
  std::normal_distribution<> normal;
  Log log;
  double state = normal(engine);
  std::array<std::array<double, kTargetsOfLog>, kPassesOfLog> e{};
  for (std::size_t pass = 0; pass < kPassesOfLog; ++pass) {
    const double of_pass = level * normal(engine);
    for (std::size_t i = 0; i < kTargetsOfLog; ++i) {
      state = correlation * state + std::sqrt(1 - correlation * correlation) * normal(engine);
      e[pass][pass % 2 == 0 ? i : kTargetsOfLog - 1 - i] = state + of_pass;
    }
  }
  for (std::size_t pass = 0; pass < kPassesOfLog; ++pass)
    for (std::size_t i = 0; i < kTargetsOfLog; ++i) {
      const std::size_t target = pass % 2 == 0 ? i : kTargetsOfLog - 1 - i;
      double of_target = 0, of_pass = 0, of_all = 0;
      for (std::size_t p = pass % 2; p < kPassesOfLog; p += 2) {
        of_target += e[p][target] / 3;
        for (std::size_t t = 0; t < kTargetsOfLog; ++t) of_all += e[p][t] / 27;
      }
      for (std::size_t t = 0; t < kTargetsOfLog; ++t) of_pass += e[pass][t] / kTargetsOfLog;
      const double residual = e[pass][target] - of_target - of_pass + of_all;
      log.visits.push_back(
          {target, pass, static_cast<double>(log.visits.size()), 1.0 / kPassesOfLog, residual});
      log.slope += slope_weight(target) * e[pass][target] / kPassesOfLog;
      log.square += residual * residual;
    }
  return log;
}

struct Slopes {
  double u_by_spread = 0, inside_percent = 0, freedom = 0;
};

Slopes slopes(double correlation, double level) {
  std::mt19937_64 engine(7);
  constexpr int kLogs = 600;
  // 54 visits, minus 18 means of targets and 4 free means of passes.
  constexpr double kFreedom = 32;
  std::vector<double> weights;
  for (std::size_t i = 0; i < kTargetsOfLog; ++i) weights.push_back(slope_weight(i));
  double square = 0, u_square = 0, freedom = 0;
  int inside = 0;
  for (int i = 0; i < kLogs; ++i) {
    const Log log = log_of(correlation, level, engine);
    const auto widened = CorrelatedNoise(log.visits, kFreedom).of(weights);
    const double variance = log.square / kFreedom / 60 / kPassesOfLog * widened.square;
    square += log.slope * log.slope / kLogs;
    u_square += variance / kLogs;
    freedom += widened.freedom / kLogs;
    inside += std::abs(log.slope) <= coverage_factor(widened.freedom) * std::sqrt(variance);
  }
  return {std::sqrt(u_square / square), 100.0 * inside / kLogs, freedom};
}

TEST(CorrelatedNoise, UIsTheSpreadOfSlopes) {
  for (const double level : {0.0, 30.0}) {
    const Slopes white = slopes(0, level), some = slopes(0.7, level), most = slopes(0.95, level);
    std::printf("u/spread %.2f, %.2f, %.2f; inside %.1f, %.1f, %.1f %%; freedom %.0f, %.0f, %.0f\n",
                white.u_by_spread, some.u_by_spread, most.u_by_spread, white.inside_percent,
                some.inside_percent, most.inside_percent, white.freedom, some.freedom,
                most.freedom);
    EXPECT_NEAR(white.u_by_spread, 1.05, 0.1);
    EXPECT_NEAR(some.u_by_spread, 1, 0.15);
    EXPECT_NEAR(most.u_by_spread, 1, 0.15);
    EXPECT_NEAR(white.inside_percent, 95.5, 2.5);
    EXPECT_NEAR(some.inside_percent, 94, 3);
    EXPECT_NEAR(most.inside_percent, 94, 3);
    EXPECT_LT(white.freedom, 25) << "of 32, as white noise is not certain";
    EXPECT_LT(some.freedom, 20) << "a correlation is known less well than a variance";
  }
}

// The level of a pass affects neither the residuals nor the variance of a figure.
TEST(CorrelatedNoise, DoesNotDependOnTheLevelOfAPass) {
  std::mt19937_64 engine(9);
  std::vector<NoisyVisit> visits = log_of(0.9, 0, engine).visits;
  std::vector<double> weights;
  for (std::size_t i = 0; i < kTargetsOfLog; ++i) weights.push_back(slope_weight(i));
  const double square = CorrelatedNoise(visits, 32).of(weights).square;
  EXPECT_EQ(CorrelatedNoise(visits, 32).of(std::vector<double>(kTargetsOfLog, 1)).square, 1);
  for (NoisyVisit& visit : visits)
    if (visit.pass == 1) visit.residual += 3;
  EXPECT_NEAR(CorrelatedNoise(visits, 32).of(weights).square, square, 1e-9);
}

// A correlation is unknown if all times are equal, if all residuals are 0, or if each target has
// one visit.
TEST(CorrelatedNoise, IsWhiteWhereNothingIsKnown) {
  std::mt19937_64 engine(9);
  Log log = log_of(0.9, 0, engine);
  std::vector<double> weights;
  for (std::size_t i = 0; i < kTargetsOfLog; ++i) weights.push_back(slope_weight(i));
  EXPECT_GT(CorrelatedNoise(log.visits, 32).of(weights).square, 1.5);
  auto alike = log.visits, still = log.visits;
  for (NoisyVisit& visit : alike) visit.residual = 0;
  for (NoisyVisit& visit : still) visit.time_s = 0;
  EXPECT_EQ(CorrelatedNoise(alike, 32).of(weights).square, 1);
  EXPECT_EQ(CorrelatedNoise(still, 32).of(weights).square, 1);
  EXPECT_EQ(CorrelatedNoise(still, 32).of(weights).freedom, 32);
  for (NoisyVisit& visit : log.visits)
    if (visit.target == 4) visit.residual = std::nan("");
  EXPECT_GT(CorrelatedNoise(log.visits, 28).of(weights).square, 1.3);
}

}  // namespace
}  // namespace mdof::algo
