// Contribution of the interpolation to u between the targets of a table. The true axis has random
// waves; the table contains their values at the targets only.
#include "algo/compensation/between_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr double kStep_m = 10e-3;

using RandomAxis = std::function<double(double x_m)>;
using Draw = std::function<RandomAxis(std::mt19937_64&)>;

// An axis whose error is the sum of eight waves; their lengths are between `shortest` and `longest`
// steps of the table.
Draw waves(double shortest, double longest) {
  return [=](std::mt19937_64& random) -> RandomAxis {
    struct Wave {
      double height_m, per_m, phase;
    };
    std::vector<Wave> all;
    std::uniform_real_distribution<double> log_length(std::log(shortest), std::log(longest));
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    std::normal_distribution<double> height;
    for (int i = 0; i < 8; ++i) {
      const double length = std::exp(log_length(random));
      all.push_back({1e-7 * length * height(random), 2 * std::numbers::pi / (length * kStep_m),
                     phase(random)});
    }
    return [all](double x_m) {
      double sum = 0;
      for (const auto& [size_m, per_m, start] : all) sum += size_m * std::sin(per_m * x_m + start);
      return sum;
    };
  };
}

// An axis whose error is a long bend plus the error of a ball screw; the pitch of the screw is 3 to
// 8 steps.
Draw screw() {
  return [](std::mt19937_64& random) -> RandomAxis {
    const RandomAxis bend = waves(15, 60)(random);
    std::uniform_real_distribution<double> any(0, 1);
    const double pitch_m = (3 + 5 * any(random)) * kStep_m, turn = any(random);
    const double height_m = 1e-7 * std::exp(2 * any(random));
    return [=](double x_m) {
      return bend(x_m) + height_m * std::sin(2 * std::numbers::pi * (x_m / pitch_m + turn));
    };
  };
}

// An axis whose error is a uniform cubic B-spline; its random control points are `apart` steps
// apart.
Draw spline(double apart) {
  return [=](std::mt19937_64& random) -> RandomAxis {
    std::normal_distribution<double> normal(0, 1e-6);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<double> control(64);
    for (double& c : control) c = normal(random);
    const double start = any(random);
    return [=](double x_m) {
      const double at = x_m / (apart * kStep_m) + start;
      const auto i = static_cast<std::size_t>(at);
      const double t = at - std::floor(at), r = 1 - t;
      return (r * r * r * control[i] + (3 * t * t * t - 6 * t * t + 4) * control[i + 1] +
              (3 * r * r * r - 6 * r * r + 4) * control[i + 2] + t * t * t * control[i + 3]) /
             6;
    };
  };
}

CompensationTable table_of(const RandomAxis& axis, std::size_t targets, double noise_m,
                           std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  CompensationTable table;
  for (std::size_t i = 0; i < targets; ++i)
    table.position_m.push_back(kStep_m * static_cast<double>(i));
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (const double x : table.position_m) {
      table.forward[k].push_back(axis(x) + noise_m * normal(random));
      table.reverse[k].push_back(axis(x) + noise_m * normal(random));
      table.u_forward[k].push_back(noise_m);
      table.u_reverse[k].push_back(noise_m);
    }
  add_curvatures(table);
  return table;
}

struct Coverage {
  // Intervals of ±1.96 u that contain the true error, %. `without`: between the targets, if u is
  // the u of the targets alone.
  double at_targets = 0, between = 0, without = 0;
  double rms = 0;                  // root mean square of error / u between the targets
  double ratio_percentile_95 = 0;  // 95th percentile of error / u between the targets
};

Coverage coverage(const Draw& draw, std::size_t targets, double noise_m) {
  constexpr int kTables = 2000;
  std::mt19937_64 random(11);
  int at = 0, between = 0, without = 0;
  double square = 0;
  std::vector<double> sizes;
  for (int t = 0; t < kTables; ++t) {
    const RandomAxis axis = draw(random);
    const auto table = table_of(axis, targets, noise_m, random);
    std::uniform_int_distribution<std::size_t> any(0, targets - 1);
    const auto by_u = [&](double x_m, bool whole) {
      const TableValue v = table_at(table, x_m, TableSide::forward);
      return std::abs(v.error[0] - axis(x_m)) / (whole ? v.u[0] : noise_m);
    };
    at += by_u(table.position_m[any(random)], true) <= 1.959964;
    std::uniform_real_distribution<double> anywhere(0, table.position_m.back());
    const double x_m = anywhere(random);
    between += by_u(x_m, true) <= 1.959964;
    without += by_u(x_m, false) <= 1.959964;
    sizes.push_back(by_u(x_m, true));
    square += sizes.back() * sizes.back() / kTables;
  }
  std::sort(sizes.begin(), sizes.end());
  return {100.0 * at / kTables, 100.0 * between / kTables, 100.0 * without / kTables,
          std::sqrt(square), sizes[kTables * 95 / 100]};
}

// u is the root mean square of the errors. The error of a few waves is bounded, so intervals of
// ±1.96 u contain more than 95 % of the errors.
TEST(BetweenTargets, AnIntervalHoldsTheTruthOfARandomAxis) {
  const struct {
    const char* name;
    Draw draw;
    std::size_t targets;
  } cases[] = {{"waves of 6 to 30 steps", waves(6, 30), 13},
               {"waves of 3 to 12 steps", waves(3, 12), 7},
               {"waves of 3 to 12 steps", waves(3, 12), 31},
               {"waves of 1.5 to 6 steps", waves(1.5, 6), 13},
               {"ball screw", screw(), 13},
               {"spline of 1.5 steps", spline(1.5), 13},
               {"spline of 3 steps", spline(3), 21}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.name);
    const Coverage found = coverage(c.draw, c.targets, 5e-9);
    std::printf(
        "%-24s %2zu targets: %.1f %% at, %.1f %% between, %.1f %% without, errors %.2f u, 95 %% "
        "of them below %.2f u\n",
        c.name, c.targets, found.at_targets, found.between, found.without, found.rms,
        found.ratio_percentile_95);
    EXPECT_GE(found.at_targets, 94);
    EXPECT_LE(found.at_targets, 96.5);
    EXPECT_GE(found.between, 92.5);
    EXPECT_LE(found.between, 99.5);
    EXPECT_LT(found.without, 60);  // control: without the contribution of the interpolation
    EXPECT_GT(found.rms, 0.9);
    EXPECT_LT(found.rms, 1.06);
  }
}

CompensationTable bare(const std::vector<double>& values, double u) {
  CompensationTable table;
  for (std::size_t i = 0; i < values.size(); ++i)
    table.position_m.push_back(kStep_m * static_cast<double>(i));
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    table.forward[k] = table.reverse[k] = values;
    table.u_forward[k] = table.u_reverse[k] = std::vector<double>(values.size(), u);
  }
  return table;
}

// y = c x² has the second derivative 2 c. At the fraction s of a step h, the distance between the
// parabola and its chord is c s (1 - s) h².
TEST(BetweenTargets, UOfAParabolaIsItsDistanceFromTheChord) {
  constexpr double c = 2e-3;
  std::vector<double> values;
  for (int i = 0; i < 9; ++i) values.push_back(c * std::pow(kStep_m * i, 2));
  const auto table = bare(values, 1e-9);
  for (const double s : {0.1, 0.5, 0.8}) {
    const TableValue v = table_at(table, kStep_m * (4 + s), TableSide::mean);
    EXPECT_NEAR(v.u_interpolation[1], c * s * (1 - s) * kStep_m * kStep_m, 2e-11) << s;
    EXPECT_NEAR(v.error[1] - c * std::pow(kStep_m * (4 + s), 2), v.u_interpolation[1], 2e-11);
  }
}

TEST(BetweenTargets, InterpolationUIsZeroAtTargetsAndNeverReducesU) {
  auto table = bare({0, 1e-6, -1e-6, 2e-6, 0, 1e-6, 3e-6}, 1e-8);
  table.u_forward[0][3] = 5e-8;
  for (std::size_t i = 0; i < table.position_m.size(); ++i) {
    const TableValue at = table_at(table, table.position_m[i], TableSide::forward);
    EXPECT_EQ(at.u_interpolation[0], 0) << i;
    EXPECT_EQ(at.u[0], table.u_forward[0][i]) << i;
    if (i + 1 == table.position_m.size()) break;
    for (const double s : {0.001, 0.5, 0.999}) {
      const double x_m = table.position_m[i] + s * kStep_m;
      EXPECT_GE(table_at(table, x_m, TableSide::forward).u[0],
                (1 - s) * table.u_forward[0][i] + s * table.u_forward[0][i + 1]);
    }
  }
  EXPECT_GT(table_at(table, 1, TableSide::forward).u_interpolation[0],
            1e-6);  // the last value applies beyond the end
}

// The second differences of the five near targets contain only noise. They must not hide the
// curvature over the long interval.
TEST(BetweenTargets, NearTargetsDoNotHideTheCurvatureOfALongInterval) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 1e-9);
  CompensationTable table;
  table.position_m = {0, 1e-3, 2e-3, 3e-3, 4e-3, 60e-3};
  const auto parabola = [](double x) { return 0.5 * 1e-3 * x * x; };
  for (int t = 0; t < 200; ++t) {
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      table.forward[k].clear();
      for (const double x : table.position_m)
        table.forward[k].push_back(parabola(x) + noise(random));
      table.reverse[k] = table.forward[k];
      table.u_forward[k] = table.u_reverse[k] = std::vector<double>(6, 1e-9);
    }
    add_curvatures(table);
    const TableValue value = table_at(table, 32e-3, TableSide::forward);
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double off = std::abs(value.error[k] - parabola(32e-3));
      EXPECT_LT(off, value.u[k]);
      EXPECT_GT(off, value.u[k] / 20);  // R is 4 with few second differences, and noise adds to u
    }
  }
}

// Noise is not curvature. The contribution of the noise to the second differences is subtracted.
TEST(BetweenTargets, NoiseIsSubtractedFromCurvature) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 1e-8);
  double sum = 0;
  for (int t = 0; t < 200; ++t) {
    std::vector<double> values(61);
    for (double& v : values) v = normal(random);
    const TableValue v = table_at(bare(values, 1e-8), 30.5 * kStep_m, TableSide::forward);
    sum += v.u_interpolation[0] * v.u_interpolation[0] / 200;
  }
  EXPECT_LT(std::sqrt(sum), 1.0e-8);  // without subtraction: 1.22e-8 and more
}

TEST(BetweenTargets, PreparedTableGivesTheSameUAndBridgesGaps) {
  auto table = bare({0, 1e-6, kNaN, 2e-6, 0, 1e-6, 3e-6}, 1e-8);
  auto prepared = table;
  add_curvatures(prepared);
  for (const double at : {0.3, 1.4, 2.5, 5.5}) {
    const TableValue one = table_at(table, at * kStep_m, TableSide::mean);
    EXPECT_EQ(one.u, table_at(prepared, at * kStep_m, TableSide::mean).u) << at;
    EXPECT_GT(one.u_interpolation[0], 0);
  }
  const double left = table_at(table, 1.4 * kStep_m, TableSide::forward).u_interpolation[0],
               middle = table_at(table, 2 * kStep_m, TableSide::forward).u_interpolation[0];
  EXPECT_GT(middle, left);
  EXPECT_TRUE(std::isnan(table_at(bare({0, 1e-6}, 1e-8), 5e-3, TableSide::mean).u[0]));
}

}  // namespace
}  // namespace mdof::algo
