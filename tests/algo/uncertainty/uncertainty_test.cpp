// The stated uncertainty of the mean of a stop is compared with the scatter of the means of many
// stops.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "algo/iso230/target_means.h"
#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/points/robust_mean.h"
#include "algo/uncertainty/statistics/visit_scatter.h"
#include "tests/algo/stepping_log.h"

namespace mdof::algo {
namespace {

// Noise with a standard deviation of 1 nm and the correlation `phi` between consecutive samples.
struct Noise {
  explicit Noise(double correlation) : phi(correlation), state(unit(engine)) {}
  double phi;
  std::mt19937_64 engine{11};
  std::normal_distribution<> unit;
  double state;
  double next() {
    state = phi * state + std::sqrt(1 - phi * phi) * unit(engine);
    return 1e-9 * state;
  }
};

double stated_over_true(const std::vector<Point>& points, std::size_t skip = 0) {
  double stated = 0, square = 0;
  for (std::size_t i = skip; i < points.size(); ++i) {
    stated += points[i].probe_u_m[0] * points[i].probe_u_m[0];
    square += points[i].probe_m[0] * points[i].probe_m[0];  // the true value is 0
  }
  return std::sqrt(stated / square);
}

// Simulates an axis that moves between two positions and makes `stops` stops of 0.5 s. The probe is
// on a separate device, which takes one sample in the time of `every` scans of the encoder.
std::vector<Point> measure(int every, double phi, int stops) {
  constexpr double kRate_hz = 1000;
  Noise noise{phi};
  Aligner aligner({.lag_bound_s = 3, .max_gap_s = 0.1}, {"A"});
  DwellDetector detector({}, {"A"}, {200e-6});
  FrameBlock frames;
  std::vector<Point> points;
  std::int64_t row = 0;
  for (int stop = 0; stop < stops; ++stop) {
    SampleBlock encoder{"scale", {{"encoder", Unit::metre}}, {}, {{}}, {}, 0};
    SampleBlock probe{"amplifier", {{"A", Unit::metre}}, {}, {{}}, {}, 0};
    for (int i = 0; i < 600; ++i, ++row) {
      const double part = std::min(1.0, i / 100.0), from = stop % 2 ? 1e-3 : 0, to = 1e-3 - from;
      const auto time_ns = static_cast<std::int64_t>(static_cast<double>(row) / kRate_hz * 1e9);
      encoder.time_ns.push_back(time_ns);
      encoder.value[0].push_back(from + (to - from) * part);
      if (row % every != 0) continue;
      probe.time_ns.push_back(time_ns + (every > 1 ? 300'000 : 0));
      probe.value[0].push_back(noise.next());
    }
    EXPECT_TRUE(aligner.push(probe, frames));
    EXPECT_TRUE(aligner.push(encoder, frames));
  }
  aligner.flush(frames);
  detector.push(frames, points);
  detector.flush(points);
  return points;
}

TEST(Uncertainty, CountsTheSamplesOfASlowProbeOnce) {
  for (const int every : {1, 2, 10, 40}) {
    const auto points = measure(every, 0, 400);
    ASSERT_GE(points.size(), 399u);
    const double ratio = stated_over_true(points, 2);
    EXPECT_GT(ratio, 0.8) << every;
    EXPECT_LT(ratio, 1.25) << every;
  }
}

TEST(Uncertainty, CoversSlowNoiseWithinADwell) {
  for (const double phi : {0.5, 0.9, 0.95}) {
    const double ratio = stated_over_true(measure(1, phi, 400), 2);
    EXPECT_GT(ratio, 0.8) << phi;
    EXPECT_LT(ratio, 1.25) << phi;
  }
}

TEST(Uncertainty, IsCorrectForFewAndManyReadings) {
  std::vector<double> scratch;
  for (const std::size_t n : {5u, 10u, 50u, 400u, 4000u}) {
    for (const double phi : {0.0, 0.5, 0.9, 0.99}) {
      if ((1 + phi) / (1 - phi) > static_cast<double>(n) / 16) continue;
      Noise noise{phi};
      double stated = 0, square = 0;
      for (int trial = 0; trial < 600; ++trial) {
        noise.state = noise.unit(noise.engine);
        std::vector<double> x(n);
        for (double& v : x) v = noise.next();
        const RobustMean mean = robust_mean(x, 1e-6, scratch);
        stated += mean.u * mean.u;
        square += mean.mean * mean.mean;
      }
      EXPECT_GT(std::sqrt(stated / square), 0.8) << n << " " << phi;
      EXPECT_LT(std::sqrt(stated / square), 1.25) << n << " " << phi;
    }
  }
}

TEST(Uncertainty, DoesNotUseAProbeWithFewSamples) {
  const auto points = measure(90, 0, 4);  // four samples of the probe per stop
  ASSERT_FALSE(points.empty());
  EXPECT_TRUE(std::isnan(points[1].probe_m[0]));
  EXPECT_TRUE(has_flag(points[1], Flag::slow, "A"));
}

// The readings of the probe are rounded to coarse steps. u covers the rounding for changing and for
// constant readings.
TEST(Uncertainty, CoversRounding) {
  for (const double noise_um : {0.0, 0.002, 0.02}) {
    SteppingLog log;
    log.probe_noise_um = noise_um;
    log.probe_step_um = 0.1;
    log.drift_um_per_min = 0;
    const FrameBlock frames = log.frames();
    DwellDetector detector({}, log.ids(), std::vector<double>(5, 200e-6));
    std::vector<Point> points;
    detector.push(frames, points);
    detector.flush(points);
    detector.mark(points);
    ASSERT_EQ(points.size(), 78u);
    double stated = 0, square = 0;
    for (const Point& p : points) {
      const auto truth_um = log.readings_um(1e3 * p.position_m);
      EXPECT_TRUE(p.flags.empty()) << to_string(p.flags);
      for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_GT(p.probe_u_m[k], 0);
        stated += p.probe_u_m[k] * p.probe_u_m[k];
        square += std::pow(p.probe_m[k] - 1e-6 * truth_um[k], 2);
      }
    }
    EXPECT_GT(std::sqrt(stated / square), 0.8) << noise_um;
    // For noise between 0 and half a step, u is larger than necessary, because a part of the
    // rounding error averages out.
    EXPECT_LT(std::sqrt(stated / square), noise_um > 0.01 ? 3.0 : 1.4) << noise_um;
  }
}

TEST(Uncertainty, LargeNoiseAveragesTheRounding) {
  SteppingLog log;
  log.probe_noise_um = 0.1;
  log.probe_step_um = 0.1;
  log.drift_um_per_min = 0;
  DwellDetector detector({}, log.ids(), std::vector<double>(5, 200e-6));
  std::vector<Point> points;
  detector.push(log.frames(), points);
  detector.flush(points);
  double stated = 0, square = 0;
  for (const Point& p : points) {
    const auto truth_um = log.readings_um(1e3 * p.position_m);
    for (std::size_t k = 0; k < 5; ++k) {
      stated += p.probe_u_m[k] * p.probe_u_m[k];
      square += std::pow(p.probe_m[k] - 1e-6 * truth_um[k], 2);
    }
  }
  EXPECT_GT(std::sqrt(stated / square), 0.8);
  EXPECT_LT(std::sqrt(stated / square), 1.25);
}

// A ramp of equal steps and exact numbers have no resolution.
TEST(Uncertainty, SimulationWithoutNoiseHasNoResolution) {
  Resolution ramp, exact;
  std::vector<double> x(200, 0.0), y(200, 0.0);
  for (std::size_t i = 20; i < 180; ++i) x[i] = 1e-9 * static_cast<double>(i - 19);
  for (std::size_t i = 180; i < 200; ++i) x[i] = x[179];
  for (std::size_t i = 1; i < 200; ++i) y[i] = y[i - 1] + 1e-9 * std::abs(std::sin(double(i)));
  ramp.add(x);
  exact.add(y);
  EXPECT_EQ(ramp.step(), 0);
  EXPECT_EQ(exact.step(), 0);
  EXPECT_DOUBLE_EQ(with_resolution(0, 0, 12e-9), 12e-9 / std::sqrt(12.0));
}

// The scatter of the visits after a change in proportion to time is removed. A separate
// least-squares fit of one slope over time and a mean of each target and direction gives the
// expected values.
struct TimedVisits {
  std::vector<MeasuredPoint> points;
  std::vector<Errors5> values;
  std::vector<double> time_s;
};

TimedVisits timed_visits(int runs, double per_s) {
  TimedVisits all;
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  double t = 100;
  for (int run = 1; run <= runs; ++run)
    for (const int direction : {1, -1})
      for (int target = 1; target <= 4; ++target) {
        MeasuredPoint p;
        p.run = run;
        p.target = direction > 0 ? target : 5 - target;
        p.point.direction = direction;
        p.errors.valid = !(run == 2 && target == 3);
        all.points.push_back(p);
        t += 2 + 0.3 * target;
        all.time_s.push_back(t);
        Errors5& value = all.values.emplace_back();
        for (std::size_t k = 0; k < 5; ++k)
          value[k] =
              10 * p.target + 3 * direction + per_s * t * static_cast<double>(k) + normal(engine);
      }
  return all;
}

// Sum of the squared residuals of a fit of one mean for each target and direction and one slope
// over time.
std::vector<double> slope_residual_squares(const TimedVisits& all) {
  std::map<std::pair<int, int>, Eigen::Index> places;
  for (const MeasuredPoint& p : all.points)
    if (p.errors.valid) places.emplace(std::pair(p.target, p.point.direction), places.size());
  const auto n = static_cast<Eigen::Index>(all.points.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(places.size()) + 1);
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!all.points[at].errors.valid) continue;
    A(i, places.at({all.points[at].target, all.points[at].point.direction})) = 1;
    A(i, A.cols() - 1) = all.time_s[at];
    for (Eigen::Index k = 0; k < 5; ++k) y(i, k) = all.values[at][static_cast<std::size_t>(k)];
  }
  const Eigen::MatrixXd left = y - A * A.colPivHouseholderQr().solve(y);
  std::vector<double> squares;
  for (Eigen::Index k = 0; k < 5; ++k) squares.push_back(left.col(k).squaredNorm());
  return squares;
}

TEST(SteadyScatter, IsTheResidualOfASlopeOverTime) {
  for (const double per_s : {0.0, 2.0}) {
    const TimedVisits all = timed_visits(3, per_s);
    const VisitScatter scatter(all.points);
    const auto found = scatter.without_trend(all.values, all.time_s);
    const std::vector<double> squares = slope_residual_squares(all);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(found.variance[k], squares[k] / (22 - 8 - 1), 1e-9 * squares[k]);
  }
}

// All visits have the same time, so no slope can be removed.
TEST(SteadyScatter, EqualsTheVisitScatterAtOneTime) {
  TimedVisits all = timed_visits(3, 0);
  const VisitScatter scatter(all.points);
  all.time_s.assign(all.time_s.size(), 5);
  EXPECT_EQ(scatter.without_trend(all.values, all.time_s).variance,
            scatter.of(all.values).variance);
  EXPECT_EQ(scatter.without_trend(all.values, all.time_s).freedom, scatter.of(all.values).freedom);
}

// With one degree of freedom, a fitted slope would leave no degree of freedom, so none is fitted.
TEST(SteadyScatter, HasOneDegreeOfFreedomForTwoVisits) {
  TimedVisits all = timed_visits(1, 0);
  MeasuredPoint again = all.points[2];
  again.run = 2;
  all.points.push_back(again);
  all.values.push_back(all.values[2]);
  for (double& v : all.values.back()) v += 4;
  all.time_s.push_back(1000);
  const auto found = VisitScatter(all.points).without_trend(all.values, all.time_s);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(found.variance[k], 8, 1e-9);
    EXPECT_EQ(found.freedom[k], 1);  // not 64/25: the visits determine one deviation only
  }
}

// The means of the runs are 2, 4 and 9 times (k + 1); the two directions differ by 6. The mean of
// both directions has u = s/√3 with s² = 13. This is larger than the u from the separate
// directions.
TEST(TargetMeansByHand, MeanOfBothDirectionsHasTheRunScatter) {
  std::vector<MeasuredPoint> points;
  const double of_run[] = {2, 4, 9};
  for (int run = 1; run <= 3; ++run)
    for (const int direction : {1, -1}) {
      MeasuredPoint p;
      p.run = run;
      p.target = 1;
      p.point.direction = direction;
      p.errors.valid = true;
      Errors5 named{};
      for (std::size_t k = 0; k < 5; ++k)
        named[k] = static_cast<double>(k + 1) * (of_run[run - 1] + 3 * direction);
      p.errors.local = local_from_named(Axis::x, named);
      points.push_back(p);
    }
  const auto means = target_means({Axis::x, {}}, points, Approach::both);
  ASSERT_EQ(means.size(), 1U);
  EXPECT_EQ(means[0].target, 1);
  EXPECT_EQ(means[0].n, 6U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(means[0].named[k], 5 * static_cast<double>(k + 1), 1e-12);
    EXPECT_NEAR(means[0].u[k], std::sqrt(13. / 3) * static_cast<double>(k + 1), 1e-12);
  }
}

}  // namespace
}  // namespace mdof::algo
