// Published results: the squareness example in the manual of a laser interferometer, and the data
// set Norris of NIST StRD.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "algo/compensation/compensation.h"
#include "algo/iso230/line_fit.h"
#include "algo/iso230/squareness.h"
#include "algo/iso230/squareness_lines.h"
#include "algo/iso230/straightness.h"
#include "algo/iso230/target_means.h"
#include "algo/model/restate.h"
#include "algo/points/robust_mean.h"

namespace mdof::algo {
namespace {

const std::vector<double> kAxis1_m = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
const std::vector<double> kAxis1_um = {-0.3, 0.9, 1.5, 2.5, 2.9, 3.6, 4.2, 5.1, 5.9, 7.2};
const std::vector<double> kAxis2_m = {0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45};
const std::vector<double> kAxis2_um = {-0.5, -1.2, -2.5, -3.8, -4.0, -4.8, -5.9, -6.2, -7.4, -8.8};

TEST(LineFit, MatchesTheLinesOfTheManual) {
  const Line one = least_squares_line(kAxis1_m, kAxis1_um);
  EXPECT_NEAR(one.slope, 7.654545, 1e-6);
  EXPECT_NEAR(one.intercept, -0.094545, 1e-6);
  EXPECT_NEAR(deviations_from(one, kAxis1_m, kAxis1_um).peak_to_valley, 0.703636, 1e-6);
  const Line ends = end_point_line(kAxis1_m, kAxis1_um);
  EXPECT_NEAR(ends.slope, 8.333333, 1e-6);
  EXPECT_NEAR(deviations_from(ends, kAxis1_m, kAxis1_um).peak_to_valley, 0.866667, 1e-6);
  const Line two = least_squares_line(kAxis2_m, kAxis2_um);
  EXPECT_NEAR(two.slope, -17.418182, 1e-6);
  EXPECT_NEAR(deviations_from(two, kAxis2_m, kAxis2_um).peak_to_valley, 1.083636, 1e-6);
  EXPECT_NEAR(two.slope - one.slope, -25.0727, 1e-4);  // squareness in the manual, µrad
}

// If several deviations are equal, the index of the first is reported.
TEST(LineFit, ReportsTheFirstOfEqualDeviations) {
  const std::vector<double> x = {0, 1, 2, 3, 4}, y = {0, 2, -1, 2, -1};
  const Deviations d = deviations_from(Line{}, x, y);
  EXPECT_EQ(d.peak, 1u);
  EXPECT_EQ(d.valley, 2u);
  EXPECT_EQ(d.peak_to_valley, 3);
}

TEST(LineFit, AgreesWithNistNorris) {
  const std::vector<double> y = {0.1,   338.8, 118.1, 888.0, 9.2,   228.1, 668.5, 998.5, 449.1,
                                 778.9, 559.2, 0.3,   0.1,   778.1, 668.8, 339.3, 448.9, 10.8,
                                 557.7, 228.3, 998.0, 888.8, 119.6, 0.3,   0.6,   557.6, 339.3,
                                 888.0, 998.5, 778.9, 10.2,  117.6, 228.9, 668.4, 449.2, 0.2};
  const std::vector<double> x = {0.2,   337.4, 118.2, 884.6, 10.1,  226.5, 666.3, 996.3, 448.6,
                                 777.0, 558.2, 0.4,   0.6,   775.5, 666.9, 338.0, 447.5, 11.6,
                                 556.0, 228.1, 995.8, 887.6, 120.2, 0.3,   0.3,   556.8, 339.1,
                                 887.2, 999.0, 779.0, 11.1,  118.3, 229.2, 669.1, 448.9, 0.5};
  const Line line = least_squares_line(x, y);
  EXPECT_NEAR(line.intercept, -0.262323073774029, 1e-12);
  EXPECT_NEAR(line.u_intercept, 0.232818234301152, 1e-12);
  EXPECT_NEAR(line.slope, 1.00211681802045, 1e-13);
  EXPECT_NEAR(line.u_slope, 4.29796848199937e-4, 1e-15);
  EXPECT_NEAR(line.residual_sd, 0.884796396144373, 1e-12);
}

// A run whose first named error has the given values in both directions.
mdof::Run run_of(Axis axis, const std::vector<double>& x_m, const std::vector<double>& y_um) {
  mdof::Run run;
  run.header.axis = axis;
  run.header.state = RunState::complete;
  run.header.id = axis == Axis::x ? 1 : 2;
  for (const int direction : {1, -1}) {
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      MeasuredPoint p;
      p.target = static_cast<int>(i) + 1;
      p.run = 1;
      p.point.direction = direction;
      p.point.position_m = p.target_m = x_m[i];
      p.errors.valid = true;
      p.errors.local =
          local_from_named(axis, {y_um[i] * 1e-6, 0, 1e-6 * static_cast<double>(i), 0, 0});
      run.points.push_back(p);
    }
  }
  return run;
}

TEST(Squareness, CombinesBothSlopesAndTheArtefact) {
  const mdof::Run x = run_of(Axis::x, kAxis1_m, kAxis1_um),
                  y = run_of(Axis::y, kAxis2_m, kAxis2_um);
  for (const int corner : {-1, 1}) {
    const Squareness s = squareness(x, y, {2e-6, 0.5e-6, corner}).value();
    EXPECT_NEAR(s.error_rad * 1e6, 17.418182 - 7.654545 + 2 * corner, 1e-5);
    EXPECT_NEAR(s.slope_b_rad * 1e6, -17.418182, 1e-6);
    // The points have no noise, and each run visits a target once, so u contains only the artefact.
    EXPECT_DOUBLE_EQ(s.u_error_rad, 0.5e-6);
    const double slope_uncertainty_x = 1e-6 * least_squares_line(kAxis1_m, kAxis1_um).u_slope;
    const double slope_uncertainty_y = 1e-6 * least_squares_line(kAxis2_m, kAxis2_um).u_slope;
    EXPECT_NEAR(s.form_rad, std::hypot(slope_uncertainty_x, slope_uncertainty_y), 1e-15);
  }
}

// A run whose horizontal straightness has the given slope; the noise at each point has the standard
// deviation u_m.
mdof::Run noisy_run(Axis axis, double slope, double u_m, int repeat, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, u_m);
  mdof::Run run;
  run.header.axis = axis;
  run.header.state = RunState::complete;
  for (int j = 1; j <= repeat; ++j) {
    for (int i = 0; i < 8; ++i) {
      for (const int direction : {1, -1}) {
        MeasuredPoint p;
        p.target = i + 1;
        p.run = j;
        p.point.direction = direction;
        p.point.position_m = 0.01 * i;
        p.errors.valid = true;
        p.errors.local = local_from_named(axis, {slope * 0.01 * i + noise(random), 0, 0, 0, 0});
        p.errors.covariance[0] = u_m * u_m;
        run.points.push_back(p);
      }
    }
  }
  return run;
}

TEST(Squareness, UncertaintyMatchesTheScatter) {
  std::mt19937_64 random(5);
  for (const int repeats : {1, 3}) {
    double sum = 0, square = 0, stated2 = 0;
    constexpr int kTrials = 400;
    for (int i = 0; i < kTrials; ++i) {
      const auto x = noisy_run(Axis::x, 3e-6, 10e-9, repeats, random);
      const auto y = noisy_run(Axis::y, -8e-6, 10e-9, repeats, random);
      const Squareness s = squareness(x, y, {}).value();
      sum += s.error_rad;
      square += s.error_rad * s.error_rad;
      stated2 += s.u_error_rad * s.u_error_rad;
    }
    const double mean = sum / kTrials, sd = std::sqrt(square / kTrials - mean * mean);
    EXPECT_NEAR(mean, 5e-6, 4 * sd / std::sqrt(kTrials));
    EXPECT_NEAR(std::sqrt(stated2 / kTrials) / sd, repeats == 1 ? 1 : 1.2, 0.25);
  }
}

TEST(Squareness, NamesTheRunOfTheWrongAxis) {
  const mdof::Run x = run_of(Axis::x, kAxis1_m, kAxis1_um);
  const auto refused = squareness(x, x, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("run 1 measures axis X"), std::string::npos);
}

// Two rigs: the side face of the X rig is at y = face_x, the side face of the Y rig at x = face_y,
// in mm.
std::pair<Rig, Rig> rigs_at(double face_x, double face_y, const std::string& of_x = "",
                            const std::string& of_y = "") {
  const auto text = [](const char* axis, const std::string& extra, const std::string& side) {
    return "name = \"t\"\naxis = \"" + std::string(axis) + "\"\n" + extra + "\n" +
           R"([[probe]]
id = "A"
position_mm = [3, 4, 0]
measures = "+Z"
range_um = 200
)" + side;
  };
  const std::string x = std::to_string(face_x), y = std::to_string(face_y);
  return {parse_rig(text("X", of_x,
                         "[[probe]]\nid = \"D\"\nposition_mm = [0, " + x +
                             ", 20]\nmeasures = \"+Y\"\nrange_um = 200\n"),
                    "rig_X")
              .value(),
          parse_rig(text("Y", of_y,
                         "[[probe]]\nid = \"D\"\nposition_mm = [" + y +
                             ", 0, 20]\nmeasures = \"-X\"\nrange_um = 200\n"),
                    "rig_Y")
              .value()};
}

TEST(Artefact, SignFollowsTheCornerOfItsFaces) {
  for (const double x : {15.0, -15.0}) {
    for (const double y : {15.0, -15.0}) {
      const auto [rig_x, rig_y] = rigs_at(x, y, "artefact_angle_error_urad = 3");
      const SquareArtefact artefact = combined_artefact(rig_x, rig_y, {}).value();
      EXPECT_EQ(artefact.corner, x * y > 0 ? 1 : -1);
      EXPECT_DOUBLE_EQ(artefact.angle_error_rad, 3e-6);
    }
  }
}

TEST(Artefact, RefusesDifferentRigsOrAnUnknownCorner) {
  const std::string three = "artefact_angle_error_urad = 3\nu_artefact_angle_urad = 0.5";
  const std::string four = "artefact_angle_error_urad = 4\nu_artefact_angle_urad = 0.5";
  const auto [x, y] = rigs_at(15, -15, three, four);
  EXPECT_NE(combined_artefact(x, y, {}).error().message.find("3 urad in rig_X and 4 urad in rig_Y"),
            std::string::npos);
  EXPECT_DOUBLE_EQ(combined_artefact(x, y, {.angle_error_rad = 5e-6, .u_rad = {}})->angle_error_rad,
                   5e-6);
  const auto [same_x, same_y] = rigs_at(15, -15, three, three);
  EXPECT_DOUBLE_EQ(combined_artefact(same_x, same_y, {})->u_rad.value(), 0.5e-6);
  EXPECT_DOUBLE_EQ(combined_artefact(same_x, rigs_at(15, -15).second, {})->u_rad.value(), 0.5e-6);
  const auto [not_known, not_declared] = rigs_at(15, -15);
  EXPECT_FALSE(combined_artefact(not_known, not_declared, {})->u_rad);
  const auto [zero, of_zero] = rigs_at(15, -15, "u_artefact_angle_urad = 0");
  EXPECT_EQ(combined_artefact(zero, of_zero, {})->u_rad, 0);
  EXPECT_FALSE(combined_artefact(zero, same_y, {}));  // u of 0 and 0.5 µrad
  const auto [at_0, other] = rigs_at(0, -15, three);
  for (const double no_square : {1e302, -0.011, std::nan("")})
    EXPECT_FALSE(combined_artefact(same_x, same_y, {.angle_error_rad = no_square, .u_rad = {}}));
  for (const double no_u : {-1e-9, 1e302, std::nan("")})
    EXPECT_FALSE(combined_artefact(same_x, same_y, {.angle_error_rad = {}, .u_rad = no_u}));
  EXPECT_TRUE(combined_artefact(same_x, same_y, {.angle_error_rad = -0.01, .u_rad = 0.01}));
  EXPECT_NE(combined_artefact(at_0, other, {})
                .error()
                .message.find("rig_X: the rig does not state on which side of the square"),
            std::string::npos);
  const auto [no_angle, needs_none] = rigs_at(0, -15);
  EXPECT_EQ(combined_artefact(no_angle, needs_none, {})->corner, 0);
}

TEST(Straightness, ReportsBothReferenceLinesForEachApproach) {
  const mdof::Run run = run_of(Axis::x, kAxis1_m, kAxis1_um);
  const auto figures = straightness(run.header.moving(), run.points);
  ASSERT_EQ(figures.size(), 6u);  // two errors with three approaches each
  EXPECT_EQ(figures[0].error_key, "EYX_um");
  EXPECT_NEAR(figures[0].straightness_least_squares_m * 1e6, 0.703636, 1e-6);
  EXPECT_NEAR(figures[0].straightness_end_point_m * 1e6, 0.866667, 1e-6);
}

// If the body moves against the encoder, its slopes have the opposite sign.
TEST(Straightness, LinesAreOverTheTravelOfTheBody) {
  mdof::Run run = run_of(Axis::x, kAxis1_m, kAxis1_um);
  for (const bool against : {false, true}) {
    run.header.sides.against_encoder = against;
    const auto lines = straightness_lines(run.header.moving(), run.points);
    const auto figures = straightness(run.header.moving(), run.points);
    ASSERT_EQ(lines.size(), figures.size());
    const double sign = against ? -1 : 1;
    EXPECT_NEAR(lines[0].lines.minimum_zone.slope_rad * 1e6, sign * 7.833333, 1e-6);
    EXPECT_NEAR(lines[0].lines.minimum_zone.zone_m * 1e6, 0.65, 1e-6);
    EXPECT_NEAR(lines[0].lines.end_point.slope_rad, figures[0].slope_end_point_rad, 1e-18);
  }
}

TEST(Squareness, EachLineCombinesBothSlopesAndTheArtefact) {
  const mdof::Run x = run_of(Axis::x, kAxis1_m, kAxis1_um),
                  y = run_of(Axis::y, kAxis2_m, kAxis2_um);
  const Squareness s = squareness(x, y, {2e-6, 0.5e-6, -1}).value();
  const SquarenessByLine lines = squareness_lines(x, y, s).value();
  EXPECT_EQ(lines.least_squares.error_rad, s.error_rad);
  EXPECT_NEAR(lines.end_point.error_rad * 1e6, 18.444444 - 8.333333 - 2, 1e-5);
  EXPECT_NEAR(lines.minimum_zone.error_rad * 1e6, 16.666667 - 7.833333 - 2, 1e-5);
  // The manual states θ2 - θ1, which has the opposite sign: -5.2" and -5.5".
  const double arcsec = 180 * 3600 / (4 * std::atan(1.0));
  const auto manual = [&](const SquarenessLine& line) {
    return (line.slope_b_rad - line.slope_a_rad) * arcsec;
  };
  EXPECT_NEAR(manual(lines.least_squares), -5.17162, 1e-5);
  EXPECT_NEAR(manual(lines.end_point), -5.52331, 1e-5);
}

// Between the fixture and the origin of the carriage, yaw has a lever.
TEST(Squareness, EachLineRefersToTheFixture) {
  mdof::Run x = run_of(Axis::x, kAxis1_m, kAxis1_um);
  const mdof::Run y = run_of(Axis::y, kAxis2_m, kAxis2_um);
  for (MeasuredPoint& p : x.points) p.errors.local[kEz] = 3e-6 * p.point.position_m;
  const mdof::Run at_carriage = restate(x, {Reference::carriage, {}});
  ASSERT_GT(std::abs(at_carriage.points[9].errors.local[kDy] - x.points[9].errors.local[kDy]),
            1e-6);
  const SquarenessByLine here = squareness_lines(x, y, {}).value(),
                         there = squareness_lines(at_carriage, y, {}).value();
  EXPECT_NEAR(there.end_point.error_rad, here.end_point.error_rad, 1e-11);
  EXPECT_NEAR(there.minimum_zone.error_rad, here.minimum_zone.error_rad, 1e-11);
}

TEST(Angles, AreReferredToTheStart) {
  const mdof::Run run = run_of(Axis::x, kAxis1_m, kAxis1_um);
  for (const auto& f : angles(run.header.moving(), run.points)) {
    EXPECT_EQ(f.min_rad, 0);
    EXPECT_NEAR(f.max_rad, f.error_key == "EAX_urad" ? 9e-6 : 0, 1e-18);
  }
}

TEST(Compensation, SeparatesApproachesAndHoldsTheEndValues) {
  mdof::Run run = run_of(Axis::x, kAxis1_m, kAxis1_um);
  for (auto& p : run.points) {
    if (p.point.direction < 0) p.errors.local[kDz] = 5e-6;
  }
  const CompensationTable table = build_table({run}, {}).value();
  ASSERT_EQ(table.position_m.size(), 10u);
  EXPECT_NEAR(table.reverse[1][3] - table.forward[1][3], 5e-6, 1e-15);
  const TableValue at = table_at(table, 0.35, TableSide::forward);
  EXPECT_TRUE(at.inside);
  EXPECT_NEAR(at.error[0], 0.5 * (table.forward[0][3] + table.forward[0][4]), 1e-18);
  const TableValue beyond = table_at(table, 1.5, TableSide::forward);
  EXPECT_FALSE(beyond.inside);
  EXPECT_EQ(beyond.error[0], table.forward[0].back());
  EXPECT_EQ(table_at(table, -1, TableSide::reverse).error[0], table.reverse[0].front());
}

TEST(Compensation, RemovesTheSlope) {
  const mdof::Run run = run_of(Axis::x, kAxis1_m, kAxis1_um);
  const CompensationTable table = build_table({run}, {}).value();
  EXPECT_NEAR(least_squares_line(table.position_m, table.forward[0]).slope, 0, 1e-18);
  const CompensationTable raw =
      build_table({run},
                  {.remove_slope = false, .take_partial = false, .stated = {}, .machine = {}})
          .value();
  EXPECT_NEAR(raw.forward[0][9], 7.2e-6, 1e-18);
}

TEST(Compensation, RefusesRunsOfTwoAxesOrDifferentTargets) {
  const mdof::Run x = run_of(Axis::x, kAxis1_m, kAxis1_um),
                  y = run_of(Axis::y, kAxis2_m, kAxis2_um);
  EXPECT_FALSE(build_table({x, y}, {}));
  mdof::Run shifted = x;
  shifted.header.id = 3;
  for (auto& p : shifted.points) p.point.position_m += 0.02;
  EXPECT_NE(build_table({x, shifted}, {}).error().message.find("no target"), std::string::npos);
  EXPECT_FALSE(build_table({}, {}));
}

TEST(RobustMean, RejectsSpikes) {
  std::vector<double> readings, scratch;
  for (int i = 0; i < 200; ++i) readings.push_back(1e-6 + 1e-9 * ((i * 7) % 11 - 5));
  const RobustMean clean = robust_mean(readings, 1e-7, scratch);
  readings[50] = 25e-6;
  readings[120] = -25e-6;
  const RobustMean spiked = robust_mean(readings, 1e-7, scratch);
  EXPECT_EQ(spiked.rejected, 2u);
  EXPECT_NEAR(spiked.mean, clean.mean, 2e-11);
  EXPECT_NEAR(spiked.sd, clean.sd, 1e-10);
}

TEST(RobustMean, SlowNoiseHasTheLargerUncertainty) {
  std::vector<double> slow, fast, scratch;
  for (int i = 0; i < 400; ++i) {
    slow.push_back(std::sin(0.05 * i));
    fast.push_back(std::sin(2.2 * i));
  }
  const RobustMean s = robust_mean(slow, 1, scratch), f = robust_mean(fast, 1, scratch);
  EXPECT_NEAR(s.sd, f.sd, 0.05);
  EXPECT_GT(s.u, 5 * f.u);
}

// A least-squares line of two points and a line through the end points are determined by two points
// only, so their uncertainty is unknown.
TEST(LineFit, TwoPointsOrEndPointsHaveNoUncertainty) {
  const std::vector<double> x = {1, 3}, y = {5, 1};
  for (const Line& line : {least_squares_line(x, y), end_point_line(x, y)}) {
    EXPECT_NEAR(line.slope, -2, 1e-15);
    EXPECT_NEAR(line.intercept, 7, 1e-15);
    EXPECT_EQ(line.residual_sd, 0);
    EXPECT_EQ(line.u_slope, 0);
    EXPECT_EQ(line.u_intercept, 0);
  }
}

TEST(Artefact, NamesTheRigWithTheUnclearFace) {
  const std::string three = "artefact_angle_error_urad = 3\nu_artefact_angle_urad = 0.5";
  const auto [x, at_0] = rigs_at(15, 0, three, three);
  const auto refused = combined_artefact(x, at_0, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(
      refused.error().message.find("rig_Y: the rig does not state on which side of the square"),
      std::string::npos);
  EXPECT_NE(refused.error().message.find("square the face normal to X is"), std::string::npos);
  const auto [x_at_0, y] = rigs_at(0, -15, three, three);
  EXPECT_NE(combined_artefact(x_at_0, y, {}).error().message.find("square the face normal to Y is"),
            std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
