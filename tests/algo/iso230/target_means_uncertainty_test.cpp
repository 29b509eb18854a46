// The uncertainty of the mean at a target is compared with the scatter of many simulated
// measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/iso230/target_means.h"

namespace mdof::algo {
namespace {

struct Scatter {
  double noise, of_run, direction_sd;  // nm; of a point, a run, a direction of a run
};

// Root mean square of the stated u divided by the root mean square of the error of the mean. The
// true value is 0.
double stated_over_true(const Scatter& sd, int runs, Approach approach) {
  std::mt19937_64 engine(7);
  std::normal_distribution<> unit;
  double stated = 0, square = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<MeasuredPoint> points;
    for (int run = 1; run <= runs; ++run) {
      const double shift = sd.of_run * unit(engine);
      for (const int direction : {1, -1}) {
        MeasuredPoint p;
        p.target = 1;
        p.run = run;
        p.point.direction = direction;
        p.errors.valid = true;
        p.errors.local[0] =
            1e-9 * (shift + sd.direction_sd * unit(engine) + sd.noise * unit(engine));
        p.errors.covariance[0] = 1e-18 * sd.noise * sd.noise;
        points.push_back(p);
      }
    }
    const auto mean = target_means({Axis::x, {}}, points, approach).at(0);
    stated += mean.u[0] * mean.u[0];
    square += mean.named[0] * mean.named[0];
  }
  return std::sqrt(stated / square);
}

TEST(SeriesUncertainty, CoversWhatIsSlowBetweenRuns) {
  for (const auto approach : {Approach::forward, Approach::reverse, Approach::both}) {
    for (const Scatter sd : {Scatter{1, 0, 0}, {1, 10, 0}, {1, 0, 10}, {1, 10, 10}, {5, 5, 5}}) {
      for (const int runs : {2, 3, 5}) {
        const double ratio = stated_over_true(sd, runs, approach);
        EXPECT_GT(ratio, 0.9) << to_string(approach) << " " << runs << " " << sd.of_run;
        EXPECT_LT(ratio, 1.35) << to_string(approach) << " " << runs << " " << sd.of_run;
      }
    }
  }
}

TEST(SeriesUncertainty, SingleRunHasItsNoise) {
  EXPECT_NEAR(stated_over_true({1, 0, 0}, 1, Approach::both), 1, 0.05);
  EXPECT_NEAR(stated_over_true({1, 0, 0}, 1, Approach::forward), 1, 0.05);
}

}  // namespace
}  // namespace mdof::algo
