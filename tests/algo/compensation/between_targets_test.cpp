// What interpolation does to u between the targets of a table. The truth is an axis of random
// waves, which the table knows at its targets only.
#include "algo/compensation/between_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr double kStep_m = 10e-3;

// Eight waves whose lengths lie between `shortest` and `longest` steps of the table.
class RandomAxis {
 public:
  RandomAxis(double shortest, double longest, std::mt19937_64& random) {
    std::uniform_real_distribution<double> log_length(std::log(shortest), std::log(longest));
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    std::normal_distribution<double> height;
    for (int i = 0; i < 8; ++i) {
      const double length = std::exp(log_length(random));
      waves_.push_back({1e-7 * length * height(random), 2 * std::numbers::pi / (length * kStep_m),
                        phase(random)});
    }
  }
  double at(double x_m) const {
    double sum = 0;
    for (const auto& [height_m, per_m, phase] : waves_)
      sum += height_m * std::sin(per_m * x_m + phase);
    return sum;
  }

 private:
  struct Wave {
    double height_m, per_m, phase;
  };
  std::vector<Wave> waves_;
};

CompensationTable table_of(const RandomAxis& axis, std::size_t targets, double noise_m,
                           std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  CompensationTable table;
  for (std::size_t i = 0; i < targets; ++i)
    table.position_m.push_back(kStep_m * static_cast<double>(i));
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (const double x : table.position_m) {
      table.forward[k].push_back(axis.at(x) + noise_m * normal(random));
      table.reverse[k].push_back(axis.at(x) + noise_m * normal(random));
      table.u_forward[k].push_back(noise_m);
      table.u_reverse[k].push_back(noise_m);
    }
  add_curvatures(table);
  return table;
}

struct Coverage {
  double at_targets = 0, between = 0, without = 0;  // %; without: by the u of the targets alone
};

Coverage coverage(double shortest, double longest, std::size_t targets, double noise_m) {
  constexpr int kTables = 2000;
  std::mt19937_64 random(11);
  int at = 0, between = 0, without = 0;
  for (int t = 0; t < kTables; ++t) {
    const RandomAxis axis(shortest, longest, random);
    const auto table = table_of(axis, targets, noise_m, random);
    std::uniform_int_distribution<std::size_t> any(0, targets - 1);
    const auto is_held = [&](double x_m, bool whole) {
      const TableValue v = table_at(table, x_m, TableSide::forward);
      const double u = whole ? v.u[0] : noise_m;
      return std::abs(v.error[0] - axis.at(x_m)) <= 1.959964 * u ? 1 : 0;
    };
    at += is_held(table.position_m[any(random)], true);
    std::uniform_real_distribution<double> anywhere(0, table.position_m.back());
    const double x_m = anywhere(random);
    between += is_held(x_m, true);
    without += is_held(x_m, false);
  }
  return {100.0 * at / kTables, 100.0 * between / kTables, 100.0 * without / kTables};
}

// Where the axis bends between its targets u is conservative, and never too small.
TEST(BetweenTargets, AnIntervalHoldsTheTruthOfARandomAxis) {
  const struct {
    double shortest, longest;
    std::size_t targets;
  } cases[] = {{6, 30, 13}, {3, 12, 7}, {3, 12, 31}, {1.5, 6, 13}};
  for (const auto& c : cases) {
    const Coverage found = coverage(c.shortest, c.longest, c.targets, 5e-9);
    EXPECT_GE(found.at_targets, 94) << c.longest;
    EXPECT_LE(found.at_targets, 96.5) << c.longest;
    EXPECT_GE(found.between, 94) << c.longest << " steps, " << c.targets << " targets";
    EXPECT_LT(found.without, 50) << c.longest;  // the control
    std::printf(
        "waves of %g to %g steps, %zu targets: %.1f %% at, %.1f %% between, %.1f %% without\n",
        c.shortest, c.longest, c.targets, found.at_targets, found.between, found.without);
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

// Of y = c x² each second derivative is 2 c: a parabola lies c s (1 - s) h² off its chord.
TEST(BetweenTargets, OfAParabolaItIsTheDistanceFromTheChord) {
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

TEST(BetweenTargets, IsZeroAtTargetsAndNeverBelowTheirU) {
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
                std::max(table.u_forward[0][i], table.u_forward[0][i + 1]));
    }
  }
  EXPECT_EQ(table_at(table, 1, TableSide::forward).u_interpolation[0], 0);  // an end value is held
}

// Noise bends nothing, and what it seems to bend is taken off.
TEST(BetweenTargets, NoiseAloneIsNoCurvature) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, 1e-8);
  double sum = 0;
  for (int t = 0; t < 200; ++t) {
    std::vector<double> values(61);
    for (double& v : values) v = normal(random);
    const TableValue v = table_at(bare(values, 1e-8), 30.5 * kStep_m, TableSide::forward);
    sum += v.u_interpolation[0] * v.u_interpolation[0] / 200;
  }
  EXPECT_LT(std::sqrt(sum), 1.0e-8);  // not subtracted: 1.22e-8 and more
}

TEST(BetweenTargets, PreparedAndUnpreparedAreOneAndHolesAreBridged) {
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
