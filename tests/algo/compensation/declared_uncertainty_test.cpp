// Tests how the declared uncertainties of rigs affect the values of a table. Without angles, EYX at
// the fixture is the reading of probe D, so an error of D changes EYX by the same amount.
#include "algo/compensation/declared_uncertainty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "schema/run_json.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using test::rig_x_with;

Run bent(const Rig& rig, std::int64_t id) {
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{2e-3 * d * d, 0, 0, 0, 0}; };
  Run run = synthetic.measure();
  run.header.id = id;
  for (MeasuredPoint& p : run.points) {  // one run an hour, so no two runs have a reading in common
    p.point.begin_ns += id * 3'600'000'000'000;
    p.point.end_ns += id * 3'600'000'000'000;
  }
  return run;
}

CompensationTable table_of(const std::vector<Rig>& rigs, bool remove_slope = true) {
  std::vector<Run> runs;
  for (std::size_t r = 0; r < rigs.size(); ++r)
    runs.push_back(bent(rigs[r], static_cast<std::int64_t>(r) + 1));
  TableOptions options;
  options.remove_slope = remove_slope;
  options.stated = kAtFixture;
  auto built = build_table(runs, options);
  EXPECT_TRUE(built) << built.error().message;
  CompensationTable table = built.value_or(CompensationTable{});
  const Status added = add_declared_uncertainty(table, rigs, runs, options);
  EXPECT_TRUE(added) << added.error().message;
  return table;
}

TEST(DeclaredUncertainty, IsEmptyWithoutDeclarations) {
  const auto table = table_of({rig_x_with("", "")});
  EXPECT_FALSE(table.has_declared());
  EXPECT_EQ(table.u_of(table.u_forward, 0, 1), table.u_forward[0][1]);
}

TEST(DeclaredUncertainty, OffsetCancelsOnlyInValuesRelativeToALine) {
  const Rig rig = rig_x_with("D", "u_calibration_um = 0.1");
  const auto about_line = table_of({rig}), as_measured = table_of({rig}, false);
  for (std::size_t i = 0; i < about_line.position_m.size(); ++i) {
    EXPECT_NEAR(about_line.u_declared[0][i], 0, 1e-13);
    EXPECT_NEAR(as_measured.u_declared[0][i], 0.1e-6, 1e-13);
    // The angle is relative to the first target.
    EXPECT_NEAR(as_measured.u_declared[4][i], 0, 1e-11);
  }
}

// A scale error of D changes EYX in the table by the same fraction.
TEST(DeclaredUncertainty, ScaleErrorIsProportionalToTheValue) {
  const auto table = table_of({rig_x_with("D", "u_sensitivity_ppm = 1000")});
  double most = 0;
  for (std::size_t i = 0; i < table.position_m.size(); ++i) {
    EXPECT_NEAR(table.u_declared[0][i], 1e-3 * std::abs(table.forward[0][i]), 1e-14);
    most = std::max(most, table.u_declared[0][i]);
  }
  EXPECT_GT(most, 1e-10);
}

// The value has one u, the larger u of both approaches. In reverse D reads 1 µm more or less than
// forward.
TEST(DeclaredUncertainty, UsesTheApproachWithTheLargerU) {
  const Rig rig = rig_x_with("D", "u_sensitivity_ppm = 1000");
  for (const double more_m : {1e-6, -1e-6}) {
    SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
    synthetic.truth = [](double d) { return Errors5{2e-3 * d * d, 0, 0, 0, 0}; };
    synthetic.added = [=](std::size_t k, double, double, double time_s) {
      return k >= 3 && static_cast<int>((time_s - 5) / 90) % 2 == 1 ? more_m : 0.0;
    };
    const std::vector<mdof::Run> runs = {synthetic.measure()};
    TableOptions options;
    options.remove_slope = false;
    options.stated = kAtFixture;
    CompensationTable table = build_table(runs, options).value();
    ASSERT_TRUE(add_declared_uncertainty(table, {rig}, runs, options));
    for (std::size_t i = 0; i < table.position_m.size(); ++i) {
      const double forward = std::abs(table.forward[0][i]), reverse = std::abs(table.reverse[0][i]);
      EXPECT_NEAR(reverse - forward, std::abs(table.forward[0][i] + more_m) - forward, 1e-12);
      EXPECT_NEAR(table.u_declared[0][i], 1e-3 * std::max(forward, reverse), 1e-13) << i;
    }
  }
}

// Two runs with the same fixture have the same error of D. If the second run
// has another fixture, which is exact, half of this error remains in the mean.
TEST(DeclaredUncertainty, IsNotReducedByMoreRunsOfOneFixture) {
  const Rig rig = rig_x_with("D", "u_calibration_um = 0.1"), exact = rig_x_with("", "");
  EXPECT_NEAR(table_of({rig, rig}, false).u_declared[0][3], 0.1e-6, 1e-13);
  EXPECT_NEAR(table_of({rig, exact}, false).u_declared[0][3], 0.05e-6, 1e-13);
}

// The targets of two runs differ by some micrometres; the runs still measure the same surface.
TEST(DeclaredUncertainty, RunsOverOnePlaneShareItsFlatnessError) {
  const Rig rig = rig_x_with("", "",
                             "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n"
                             "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.1\n");
  std::vector<mdof::Run> runs = {bent(rig, 1), bent(rig, 2)};
  for (MeasuredPoint& p : runs[1].points)
    p.point.position_m += 2e-6 * std::sin(50.0 * static_cast<double>(p.target));
  TableOptions options;
  options.remove_slope = false;
  options.stated = kAtFixture;
  auto both = build_table(runs, options).value();
  ASSERT_TRUE(add_declared_uncertainty(both, {rig, rig}, runs, options));
  const auto one = table_of({rig}, false);
  for (std::size_t i = 2; i < one.position_m.size(); ++i)
    EXPECT_NEAR(both.u_declared[0][i] / one.u_declared[0][i], 1, 0.01) << i;
}

TEST(DeclaredUncertainty, EntersTableValuesAndHash) {
  const auto table = table_of({rig_x_with("D", "u_calibration_um = 0.1")}, false);
  for (const TableSide side : {TableSide::forward, TableSide::reverse, TableSide::mean}) {
    EXPECT_NEAR(table_at(table, table.position_m[3], side).u[0], 0.1e-6, 1e-13);
    const auto between = table_at(table, 0.5 * (table.position_m[2] + table.position_m[3]), side);
    EXPECT_NEAR(between.u[0], std::hypot(0.1e-6, between.u_interpolation[0]), 1e-13);
  }
  auto without = table;
  for (auto& series : without.u_declared) series.clear();
  EXPECT_NE(table_sha256(table), table_sha256(without));
}

TEST(DeclaredUncertainty, RefusesTooManyPoints) {
  const Rig rig = rig_x_with("D", "u_direction_mrad = 1");
  auto run = bent(rig, 1);
  run.points.resize(20'001, run.points.front());
  CompensationTable table;
  const Status added = add_declared_uncertainty(table, {rig}, {run}, {});
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("too many points"), std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
