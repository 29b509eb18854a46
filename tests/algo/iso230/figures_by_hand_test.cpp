// Lines, angles, tables and squareness of a few points, calculated by hand. Mutation tests
// (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algo/compensation/compensation.h"
#include "algo/iso230/line_fit.h"
#include "algo/iso230/squareness.h"
#include "algo/iso230/straightness.h"
#include "schema/sample.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

using Column = std::vector<double>;

// In run j the first named error is first_error_at(j, target) and EBX or EBY is b_of(target), in
// both directions.
template <class Y, class B>
mdof::Run run_by_hand(Axis axis, const Column& x_m, int runs, Y first_error_at, B b_of) {
  mdof::Run run;
  run.header.axis = axis;
  run.header.state = RunState::complete;
  run.header.id = axis == Axis::x ? 1 : 2;
  for (int j = 0; j < runs; ++j) {
    for (const int direction : {1, -1}) {
      for (std::size_t i = 0; i < x_m.size(); ++i) {
        MeasuredPoint p;
        p.target = static_cast<int>(i) + 1;
        p.run = j + 1;
        p.point.direction = direction;
        p.point.position_m = p.target_m = x_m[i];
        p.errors.valid = true;
        p.errors.local = local_from_named(axis, {first_error_at(j, i), 0, 0, b_of(i), 0});
        run.points.push_back(p);
      }
    }
  }
  return run;
}

// The line through (1, 5) and (4, -1) has the slope -2 and the value 7 at 0.
TEST(LineByHand, EndPointLineMatchesManualCalculation) {
  const Line line = end_point_line(Column{1, 2, 4}, Column{5, 99, -1});
  EXPECT_EQ(line.slope, -2);
  EXPECT_EQ(line.intercept, 7);
  EXPECT_EQ(line.at(2), 3);
}

// Two readings have no residual, so the uncertainty is unknown.
TEST(LineByHand, TwoReadingsHaveNoUncertainty) {
  const Line line = least_squares_line(Column{1, 3}, Column{5, 1});
  EXPECT_NEAR(line.slope, -2, 1e-15);
  EXPECT_NEAR(line.intercept, 7, 1e-15);
  EXPECT_EQ(line.u_slope, 0);
  EXPECT_EQ(line.u_intercept, 0);
  EXPECT_EQ(line.residual_sd, 0);
}

// x = 0, 1, 5 and y = 1, 0, 5 have the means 2 and 2, Sxx = 14 and Sxy = 2 + 2 + 9 = 13.
TEST(LineByHand, LeastSquaresLineHasTheExpectedU) {
  const Line line = least_squares_line(Column{0, 1, 5}, Column{1, 0, 5});
  EXPECT_NEAR(line.slope, 13 / 14.0, 1e-15);
  EXPECT_NEAR(line.intercept, 2 - 26 / 14.0, 1e-15);
  // The sum of the squared residuals is Syy - Sxy²/Sxx = 14 - 169/14 = 27/14. It has one degree of
  // freedom.
  EXPECT_NEAR(line.residual_sd, std::sqrt(27 / 14.0), 1e-14);
  EXPECT_NEAR(line.u_slope, std::sqrt(27.0) / 14, 1e-14);
  EXPECT_NEAR(line.u_intercept, std::sqrt(27 / 14.0 * (1 / 3.0 + 4 / 14.0)), 1e-14);
}

// The deviations from the line y = 2 are -3, 4, 4, -5, 0.
TEST(LineByHand, DeviationsMatchManualCalculation) {
  Line level;
  level.intercept = 2;
  const Deviations d = deviations_from(level, Column{0, 1, 2, 3, 4}, Column{-1, 6, 6, -3, 2});
  EXPECT_EQ(d.peak, 1u);
  EXPECT_EQ(d.valley, 3u);
  EXPECT_EQ(d.peak_to_valley, 9);
}

const Column kUneven_m = {0, 1e-3, 5e-3, 7e-3, 20e-3};
const Column kAngle_rad = {7e-6, 4e-6, 9e-6, 12e-6, 6e-6};

// The angle is 7 urad at the start. Relative to its start it is from -3 to 5 urad.
TEST(AnglesByHand, AreReferredToANonZeroStart) {
  const mdof::Run run = run_by_hand(
      Axis::x, kUneven_m, 1, [](int, std::size_t) { return 0.0; },
      [](std::size_t i) { return kAngle_rad[i]; });
  int found = 0;
  for (const AngleFigure& f : angles(run.header.moving(), run.points)) {
    if (f.error_key != "EBX_urad") continue;
    ++found;
    EXPECT_NEAR(f.start_rad, 7e-6, 1e-18);
    EXPECT_NEAR(f.min_rad, -3e-6, 1e-18);
    EXPECT_NEAR(f.max_rad, 5e-6, 1e-18);
  }
  EXPECT_EQ(found, 3);
}

TEST(AnglesByHand, NeedTwoTargets) {
  const auto count_target_figures = [](std::size_t n) {
    const mdof::Run run = run_by_hand(
        Axis::x, Column(kUneven_m.begin(), kUneven_m.begin() + static_cast<std::ptrdiff_t>(n)), 1,
        [](int, std::size_t) { return 0.0; }, [](std::size_t i) { return kAngle_rad[i]; });
    return angles(run.header.moving(), run.points).size();
  };
  EXPECT_EQ(count_target_figures(1), 0u);
  // Three angles (EAX, EBX, ECX) for mean, forward and reverse.
  EXPECT_EQ(count_target_figures(2), 9u);
}

TEST(TableByHand, AnglesBeginAtZeroAndTheSlopeIsRemoved) {
  const mdof::Run run = run_by_hand(
      Axis::x, kUneven_m, 1, [](int, std::size_t i) { return 3e-6 + 50e-6 * kUneven_m[i]; },
      [](std::size_t i) { return kAngle_rad[i]; });
  const CompensationTable table = build_table({run}, {}).value();
  ASSERT_EQ(table.position_m, kUneven_m);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(table.forward[0][i], 0, 1e-18) << i;
    EXPECT_NEAR(table.forward[3][i], kAngle_rad[i] - 7e-6, 1e-18) << i;
    EXPECT_NEAR(table.reverse[3][i], kAngle_rad[i] - 7e-6, 1e-18) << i;
  }
}

CompensationTable table_of(const Column& x_m, const Column& y) {
  CompensationTable table;
  table.position_m = x_m;
  for (std::size_t k = 0; k < 5; ++k) {
    table.forward[k] = table.reverse[k] = y;
    table.u_forward[k] = table.u_reverse[k] = Column(y.size(), 1e-9);
  }
  return table;
}

TEST(TableByHand, ValueAtTheOnlyPositionAppliesEverywhere) {
  const CompensationTable table = table_of({2e-3}, {5e-6});
  for (const double at_m : {0.0, 2e-3, 9e-3}) {
    const TableValue value = table_at(table, at_m, TableSide::mean);
    EXPECT_EQ(value.error[4], 5e-6) << at_m;
    EXPECT_EQ(value.inside, at_m == 2e-3) << at_m;
  }
}

// The values at 1 and 3 are missing. The table is linear from 0 to 2 and constant beyond 2.
TEST(TableByHand, IsLinearAcrossAMissingValue) {
  const CompensationTable table = table_of({0, 1, 2, 3}, {4, kNaN, 10, kNaN});
  const auto at = [&](double x) { return table_at(table, x, TableSide::forward); };
  EXPECT_EQ(at(0).error[0], 4);
  EXPECT_EQ(at(0.5).error[0], 5.5);
  EXPECT_EQ(at(1).error[0], 7);
  EXPECT_EQ(at(1.5).error[0], 8.5);
  EXPECT_EQ(at(2).error[0], 10);
  EXPECT_EQ(at(2.5).error[0], 10);
  EXPECT_EQ(at(3).error[0], 10);
  EXPECT_TRUE(at(2).inside);
  EXPECT_FALSE(at(2.1).inside);
  EXPECT_EQ(table_at(table_of({0, 1, 2}, {kNaN, 6, 8}), 0.5, TableSide::forward).error[0], 6);
}

// Two targets of two runs are the same target if they differ by at most 2 % of the smallest step of
// 1 mm.
TEST(TableByHand, MergesTargetsWithinTwoPercent) {
  const auto nought = [](auto...) { return 0.0; };
  for (const double off_m : {19.9e-6, -19.9e-6, 20.1e-6, -20.1e-6}) {
    mdof::Run first = run_by_hand(Axis::x, kUneven_m, 1, nought, nought), second = first;
    second.header.id = 7;
    for (MeasuredPoint& p : second.points) p.point.position_m += p.target == 4 ? off_m : 0;
    const auto table = build_table({first, second}, {});
    EXPECT_EQ(table.has_value(), std::abs(off_m) < 20e-6) << off_m;
  }
}

// The slopes of three runs are 10, 20 and 60 urad about the middle of unevenly spaced targets. s of
// the slopes is √700 urad, u = s/√3. The scatter at the targets alone would give a smaller u.
TEST(SquarenessByHand, IncludesTheScatterOfTheSlopes) {
  const double middle_m = 33e-3 / 5;
  const Column slopes = {10e-6, 20e-6, 60e-6};
  const auto none = [](std::size_t) { return 0.0; };
  const mdof::Run x = run_by_hand(
      Axis::x, kUneven_m, 3,
      [&](int j, std::size_t i) {
        return slopes[static_cast<std::size_t>(j)] * (kUneven_m[i] - middle_m);
      },
      none);
  const mdof::Run y = run_by_hand(
      Axis::y, kUneven_m, 1, [](int, std::size_t) { return 0.0; }, none);
  const Squareness s = squareness(x, y, {}).value();
  EXPECT_NEAR(s.slope_a_rad, 30e-6, 1e-16);
  EXPECT_NEAR(s.u_slope_a_rad, 1e-6 * std::sqrt(700 / 3.0), 1e-15);
  EXPECT_NEAR(s.u_error_rad, s.u_slope_a_rad, 1e-15);
}

// The slopes of two runs are 10 and 30 urad: s = 20/√2 urad, u = s/√2. The numbers of the runs are
// unchanged.
TEST(SquarenessByHand, UsesTwoRunsOfOneAxis) {
  const auto none = [](std::size_t) { return 0.0; };
  const mdof::Run x = run_by_hand(
      Axis::x, kUneven_m, 1, [](int, std::size_t) { return 0.0; }, none);
  const mdof::Run y = run_by_hand(
      Axis::y, kUneven_m, 2,
      [&](int j, std::size_t i) { return (j == 0 ? 10e-6 : 30e-6) * (kUneven_m[i] - 33e-3 / 5); },
      none);
  const Squareness s = squareness(x, y, {}).value();
  EXPECT_NEAR(s.slope_b_rad, 20e-6, 1e-16);
  EXPECT_NEAR(s.u_slope_b_rad, 10e-6, 1e-15);
  EXPECT_NEAR(s.error_rad, -20e-6, 1e-16);
  EXPECT_EQ(s.run_a, x.header.id);
  EXPECT_EQ(s.run_b, y.header.id);
  EXPECT_NE(s.run_a, s.run_b);
}

// The angle of the square is declared by one rig, or with the same value by both.
TEST(ArtefactByHand, OneRigMayDeclareTheAngle) {
  const Rig x_without = test::rig_x(),
            y_without = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_Y.toml").value();
  Rig x_with = x_without, y_with = y_without;
  for (Rig* rig : {&x_with, &y_with}) {
    rig->artefact_angle_error_rad = -4e-6;
    rig->u_artefact_angle_rad = 0.25e-6;
  }
  for (const auto& [x, y] :
       {std::pair(x_with, y_without), std::pair(x_without, y_with), std::pair(x_with, y_with)}) {
    const auto artefact = combined_artefact(x, y, {});
    ASSERT_TRUE(artefact);
    EXPECT_EQ(artefact->angle_error_rad, -4e-6);
    EXPECT_EQ(artefact->u_rad, 0.25e-6);
  }
  EXPECT_EQ(combined_artefact(x_without, y_without, {})->angle_error_rad, 0);
}

// The values 0, 3, -2, 2, 1 µm have a mean of 0.8 µm and a slope of 10 µrad.
TEST(StraightnessByHand, StatesPeakValleyAndUOfTheSlope) {
  const Column x = {0, 10e-3, 20e-3, 30e-3, 40e-3}, y = {0, 3e-6, -2e-6, 2e-6, 1e-6};
  const mdof::Run run = run_by_hand(
      Axis::x, x, 1, [&](int, std::size_t i) { return y[i]; }, [](std::size_t) { return 0.0; });
  const auto figures = straightness(run.header.moving(), run.points);
  ASSERT_EQ(figures.size(), 6u);
  EXPECT_EQ(figures[0].approach, std::string("forward"));
  EXPECT_EQ(figures[2].approach, std::string("reverse"));
  EXPECT_EQ(figures[0].peak_position_m, 10e-3);
  EXPECT_EQ(figures[0].valley_position_m, 20e-3);
  EXPECT_NEAR(figures[0].straightness_least_squares_m, 5.1e-6, 1e-18);
  // The residuals are -0.6, 2.3, -2.8, 1.1, 0. The sum of their squares is 14.7 µm² with 3 degrees
  // of freedom; Σ(x - x̄)² = 1000 mm².
  EXPECT_NEAR(figures[0].form_rad, 1e-6 * std::sqrt(14.7 / 3 / 1e-3), 1e-12);
  const Squareness s = squareness(run,
                                  run_by_hand(
                                      Axis::y, x, 1, [&](int, std::size_t i) { return 2 * y[i]; },
                                      [](std::size_t) { return 0.0; }),
                                  {})
                           .value();
  EXPECT_NEAR(s.form_rad, std::sqrt(5.0) * figures[0].form_rad, 1e-12);
}

// Run 3 has only the lower half of the targets. At each target, the slopes are relative to the mean
// of the runs with this target, so the slopes of the three runs do not sum to 0.
TEST(SquarenessByHand, SlopesScatterAboutTheirOwnMean) {
  const Column x = {-30e-3, -20e-3, -10e-3, 0, 10e-3, 20e-3, 30e-3};
  const Column slopes = {10e-6, 20e-6, 60e-6};
  mdof::Run run = run_by_hand(
      Axis::x, x, 3,
      [&](int j, std::size_t i) { return slopes[static_cast<std::size_t>(j)] * x[i]; },
      [](std::size_t) { return 0.0; });
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.run == 3 && p.target > 4; });
  const mdof::Run y = run_by_hand(
      Axis::y, x, 1, [](int, std::size_t) { return 0.0; }, [](std::size_t) { return 0.0; });
  // The levels of the runs follow from least squares over their common visits. The level of run 3
  // is such that its four visits equal the visits of the other runs on average.
  std::array<double, 3> level{};
  for (int turn = 0; turn < 1000; ++turn) {
    std::array<double, 7> place{};
    for (std::size_t i = 0; i < 7; ++i) {
      const std::size_t n = i < 4 ? 3 : 2;
      for (std::size_t j = 0; j < n; ++j) place[i] += (slopes[j] * x[i] - level[j]) / double(n);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t n = j < 2 ? 7 : 4;
      level[j] = 0;
      for (std::size_t i = 0; i < n; ++i) level[j] += (slopes[j] * x[i] - place[i]) / double(n);
    }
  }
  std::array<double, 7> mean{};
  for (std::size_t i = 0; i < 7; ++i) {
    const std::size_t n = i < 4 ? 3 : 2;
    for (std::size_t j = 0; j < n; ++j) mean[i] += (slopes[j] * x[i] - level[j]) / double(n);
  }
  std::array<double, 3> slope{};
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t n = j < 2 ? 7 : 4;
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double off = slopes[j] * x[i] - level[j] - mean[i];
      sx += x[i], sy += off, sxx += x[i] * x[i], sxy += x[i] * off;
    }
    slope[j] = (sxy - sx * sy / double(n)) / (sxx - sx * sx / double(n));
  }
  const double middle = (slope[0] + slope[1] + slope[2]) / 3;
  EXPECT_GT(std::abs(middle), 2e-6);
  double square = 0;
  for (const double s : slope) square += (s - middle) * (s - middle);
  EXPECT_NEAR(squareness(run, y, {}).value().u_slope_a_rad, std::sqrt(square / 6), 1e-13);
}

}  // namespace
}  // namespace mdof::algo
