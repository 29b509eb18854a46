// Tests limits from just below and just above, angles beyond one turn, and names of errors in the
// results for machines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algo/machine/compensating.h"
#include "algo/machine/geometric_tests/circle.h"
#include "algo/machine/geometric_tests/diagonal.h"
#include "algo/machine/plane_map.h"

namespace mdof::algo {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

// A path with n angles from `from_rad` on, in steps of `step_rad`.
CircularPath circular_path_from(double from_rad, double step_rad, std::size_t n) {
  CircularPath path;
  for (std::size_t i = 0; i < n; ++i) {
    path.angle_rad.push_back(from_rad + step_rad * static_cast<double>(i));
    path.ccw_m.push_back(1e-6 * std::cos(path.angle_rad.back()));
  }
  return path;
}

TEST(CircularEdges, NeedEightAnglesAndNoGapAboveAQuarter) {
  const double seventh_turn_rad = 2 * std::numbers::pi / 7;
  EXPECT_FALSE(circular_figures(circular_path_from(0, seventh_turn_rad, 7)));
  EXPECT_TRUE(
      // The eighth angle equals the first.
      circular_figures(circular_path_from(0, seventh_turn_rad, 8)));
  // Ten angles leave a gap of a quarter turn, or of a quarter turn plus 2 mrad. The gap can begin
  // at any angle and in any turn.
  for (const double from : {0.0, 1.0, 4.0, -3.0, 60.0, -60.0}) {
    EXPECT_TRUE(circular_figures(circular_path_from(from, 3 * kRightAngle / 9, 10))) << from;
    EXPECT_FALSE(circular_figures(circular_path_from(from, (3 * kRightAngle - 2e-3) / 9, 10)))
        << from;
  }
  // Half of the angles are increased by one turn. The circle is the same.
  CircularPath turned = circular_path_from(0, 2 * std::numbers::pi / 12, 12);
  for (std::size_t i = 0; i < 12; i += 2) turned.angle_rad[i] += 2 * std::numbers::pi;
  EXPECT_TRUE(circular_figures(turned));
  // The widest gap is between angles that are not the first and the last.
  CircularPath gap = circular_path_from(0, 0.1, 63);
  for (std::size_t i = 45; i-- > 25;) {
    gap.angle_rad.erase(gap.angle_rad.begin() + static_cast<std::ptrdiff_t>(i));
    gap.ccw_m.pop_back();
  }
  EXPECT_FALSE(circular_figures(gap));
}

TEST(CircularEdges, RefuseNonFiniteOrMissingNumbers) {
  const auto whole = [] {
    CircularPath path = circular_path_from(0, 0.7, 9);
    path.cw_m = path.ccw_m;
    return path;
  };
  ASSERT_TRUE(circular_figures(whole()));
  for (const auto of : {&CircularPath::angle_rad, &CircularPath::ccw_m, &CircularPath::cw_m}) {
    for (const double bad : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
      CircularPath path = whole();
      (path.*of)[8] = bad;
      EXPECT_FALSE(circular_figures(path));
    }
    CircularPath path = whole();
    (path.*of).pop_back();
    EXPECT_FALSE(circular_figures(path));
  }
  CircularPath clockwise = whole();
  clockwise.ccw_m.clear();
  EXPECT_TRUE(circular_figures(clockwise));
}

TEST(CircularEdges, CentreIsRemovedFromBothPaths) {
  CircularPath path = circular_path_from(0.3, 0.7, 9);
  path.cw_m = path.ccw_m;
  CircularFigures figures;
  figures.centre_m = {3e-6, -5e-6};
  const CircularPath out = centred(path, figures);
  for (std::size_t i = 0; i < 9; ++i) {
    const double a = path.angle_rad[i];
    const double expected = path.ccw_m[i] - 3e-6 * std::cos(a) + 5e-6 * std::sin(a);
    EXPECT_NEAR(out.ccw_m[i], expected, 1e-18);
    EXPECT_NEAR(out.cw_m[i], expected, 1e-18);
    EXPECT_EQ(out.angle_rad[i], a);
  }
}

MachineFrame frame_of(const char* id, std::size_t direction, FrameKind kind = FrameKind::linear) {
  MachineFrame frame;
  frame.id = id;
  frame.direction = direction;
  frame.kind = kind;
  return frame;
}

Machine plane_machine() {
  Machine m;
  m.frames = {frame_of("X", 0), frame_of("Y", 1)};
  m.frames[0].range = {0, 0.3};
  m.frames[1].range = {0, 0.4};
  return m;
}

// The backlash of Y depends on the direction of Y, which reverses at 90 and 270 degrees. An axis at
// rest has the mean of both directions.
TEST(CircularEdges, EachAxisHasTheErrorsOfItsDirection) {
  Machine m = plane_machine();
  m.frames[1].error[1] = {{}, {0}, {4e-6}, {}, {}};  // EYY: 4 µm if Y decreases; mean 2 µm
  CircleRequest request;
  request.centre = {0.1, 0.1};
  request.radius_m = 0.02;
  request.angles = 12;
  const auto circle = predicted_circle(m, request);
  ASSERT_TRUE(circle) << circle.error().message;
  for (std::size_t i = 0; i < 12; ++i) {
    const double sine = std::sin(circle->path.angle_rad[i]);
    // In counter-clockwise motion, Y decreases after 90 degrees and up to 270 degrees.
    const double ccw = i > 3 && i <= 9 ? 2e-6 : -2e-6;
    const double cw = i >= 3 && i < 9 ? -2e-6 : 2e-6;
    EXPECT_NEAR(circle->path.ccw_m[i], ccw * sine, 2e-10) << i;
    EXPECT_NEAR(circle->path.cw_m[i], cw * sine, 2e-10) << i;
  }
  // The rotary axis A about X must not be treated as the axis X.
  m.frames.insert(m.frames.begin(), frame_of("A", 0, FrameKind::rotary));
  m.frames[0].error[0] = {{}, {0}, {6e-6}, {}, {}};
  m.frames[2].error[1] = {};
  const auto with_table = predicted_circle(m, request);
  ASSERT_TRUE(with_table);
  for (const double off : with_table->path.ccw_m) EXPECT_NEAR(off, 0, 1e-12);
}

TEST(CircularEdges, NamesMissingErrorsAndShortTables) {
  Machine m = plane_machine();
  m.frames[0].error[0] = {{0, 0.11}, {0, 1e-6}, {}, {}, {}};  // the table of EXX ends at 110 mm
  CircleRequest request;
  request.centre = {0.1, 0.1};
  request.radius_m = 0.02;
  request.angles = 8;
  const auto circle = predicted_circle(m, request);
  ASSERT_TRUE(circle);
  EXPECT_EQ(circle->beyond, std::vector<std::string>{"EXX"});
  const auto has = [&](const char* name) {
    return std::count(circle->not_measured.begin(), circle->not_measured.end(), name);
  };
  for (const char* name : {"EYX", "EXY", "EYY"}) EXPECT_EQ(has(name), 1) << name;
  for (const char* name : {"EXX", "EZX", "EZY"}) EXPECT_EQ(has(name), 0) << name;
}

TEST(CircularEdges, RadiusIsAtMostTenMetres) {
  CircleRequest request;
  EXPECT_EQ(request.first, 0u);
  EXPECT_EQ(request.second, 1u);
  EXPECT_EQ(request.angles, 360u);
  EXPECT_FALSE(predicted_circle(plane_machine(), request));  // the request has no radius
  request.radius_m = 10;
  request.angles = 8;
  EXPECT_TRUE(predicted_circle(plane_machine(), request));
  request.radius_m = std::nextafter(10, 11);
  EXPECT_FALSE(predicted_circle(plane_machine(), request));
  request.radius_m = 0.01;
  request.angles = 100'001;
  EXPECT_FALSE(predicted_circle(plane_machine(), request));
}

// Lengths of the lines of a plane whose axes enclose 90 degrees + error.
DiagonalLines lines_at_angle_error(double error, bool two) {
  const double x = 0.4, y = 0.3, s = std::sin(error);
  DiagonalLines lines{{{x}}, {{y}}, {{std::sqrt(x * x + y * y - 2 * x * y * s)}}, {}, 1e-7};
  if (two) lines.other.length_m = {std::sqrt(x * x + y * y + 2 * x * y * s)};
  return lines;
}

TEST(DiagonalEdges, AxesAreWithinSixDegreesOfSquare) {
  for (const bool two : {false, true})
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(squareness_from_diagonals(lines_at_angle_error(sign * std::asin(0.0999), two)));
      EXPECT_FALSE(squareness_from_diagonals(lines_at_angle_error(sign * std::asin(0.1001), two)));
    }
}

// Far from a right angle, the sensitivities differ from the sensitivities at a right angle.
// Expected: central differences.
TEST(DiagonalEdges, SensitivitiesAreCorrectFarFromARightAngle) {
  for (const bool two : {false, true}) {
    DiagonalLines lines = lines_at_angle_error(0.08, two);
    const auto found = squareness_from_diagonals(lines);
    ASSERT_TRUE(found);
    double squares = 0;
    for (auto* line : {&lines.first, &lines.second, &lines.diagonal, &lines.other}) {
      if (line->length_m.empty()) continue;
      const double before = line->length_m[0], h = 1e-5;
      line->length_m[0] = before + h;
      const double above = squareness_from_diagonals(lines)->angle_error_rad;
      line->length_m[0] = before - h;
      const double below = squareness_from_diagonals(lines)->angle_error_rad;
      line->length_m[0] = before;
      squares += std::pow((above - below) / (2 * h) * 1e-7, 2);
    }
    EXPECT_NEAR(found->u_rad / std::sqrt(squares), 1, 1e-6) << two;
    EXPECT_TRUE(std::isinf(found->freedom));
    EXPECT_EQ(found->u_repeat_rad, 0);
  }
}

TEST(DiagonalEdges, NeedThreeLinesWithPositiveLengths) {
  const DiagonalLines whole = lines_at_angle_error(0, true);
  for (const auto line : {&DiagonalLines::first, &DiagonalLines::second, &DiagonalLines::diagonal,
                          &DiagonalLines::other}) {
    for (const double bad : {0.0, -0.5, HUGE_VAL}) {
      DiagonalLines lines = whole;
      (lines.*line).length_m.push_back(bad);
      const auto found = squareness_from_diagonals(lines);
      ASSERT_FALSE(found);
      EXPECT_NE(found.error().message.find("above 0"), std::string::npos);
    }
    DiagonalLines lines = whole;
    (lines.*line).length_m.clear();
    EXPECT_EQ(squareness_from_diagonals(lines).has_value(), line == &DiagonalLines::other);
  }
}

TEST(PlaneMapEdges, RangeIsGivenOrCommonToTheTables) {
  MachineFrame x = frame_of("X", 0);
  EXPECT_FALSE(range_of(x));
  x.error[1] = {{0, 0.1}, {0, 1e-6}, {}, {}, {}};
  EXPECT_EQ(*range_of(x), (std::array<double, 2>{0, 0.1}));
  x.error[4] = {{0.02, 0.05, 0.2}, {0, 0, 1e-6}, {}, {}, {}};
  EXPECT_EQ(*range_of(x), (std::array<double, 2>{0.02, 0.1}));
  x.error[5] = {{-0.1, 0.08}, {0, 1e-6}, {}, {}, {}};
  EXPECT_EQ(*range_of(x), (std::array<double, 2>{0.02, 0.08}));
  x.error[0] = {{0.08, 0.3}, {0, 1e-6}, {}, {}, {}};  // the tables have only one position in common
  EXPECT_FALSE(range_of(x));
  x.range = {-1, 2};
  EXPECT_EQ(*range_of(x), (std::array<double, 2>{-1, 2}));
}

TEST(PlaneMapEdges, StepsAreEqualAndAtLeastOne) {
  EXPECT_EQ(steps_over({1, 1.001}, 0.01), (std::vector<double>{1, 1.001}));
  EXPECT_EQ(steps_over({0, 1}, 0.4).size(), 4u);  // 2.5 steps are rounded to 3
  EXPECT_EQ(steps_over({0, 1}, 0.41).size(), 3u);
  const auto at = steps_over({2, 8}, 2);
  EXPECT_EQ(at, (std::vector<double>{2, 4, 6, 8}));
}

TEST(PlaneMapEdges, FollowsTheOptionsOfTheRequest) {
  Machine m = plane_machine();
  m.frames.push_back(frame_of("Z", 2));
  m.frames[2].error[0] = {{0, 0.1}, {0, 10e-6}, {}, {}, {}};  // EXZ
  // EYX, with a value for each direction.
  m.frames[0].error[1] = {{}, {2e-6}, {4e-6}, {}, {}};
  m.frames[0].error[5] = {{}, {1e-5}, {}, {}, {}};  // ECX
  m.tool_m = {0, 0.1, 0};
  PlaneMapRequest request;
  EXPECT_EQ(request.first, 0u);
  EXPECT_EQ(request.second, 1u);
  EXPECT_EQ(request.step_m, 0.01);
  EXPECT_FALSE(request.without_angles);
  request.step_m = 0.1;
  request.others[2] = 0.05;
  const auto mean = plane_map(m, request);
  ASSERT_TRUE(mean) << mean.error().message;
  EXPECT_EQ(mean->first, 0u);
  EXPECT_EQ(mean->second, 1u);
  const PlanePoint& point = mean->points[0];
  EXPECT_NEAR(point.error[1], 3e-6, 1e-10);
  EXPECT_NEAR(point.error[0], 5e-6 - 1e-5 * 0.1, 1e-10);
  EXPECT_TRUE(mean->beyond.empty());
  request.approach = MachineApproach::reverse;
  EXPECT_NEAR(plane_map(m, request)->points[0].error[1], 4e-6, 1e-10);
  request.without_angles = true;
  EXPECT_NEAR(plane_map(m, request)->points[0].error[0], 5e-6, 1e-12);
  request.others[2] = 0.15;
  EXPECT_EQ(plane_map(m, request)->beyond, std::vector<std::string>{"EXZ"});
  // Expected names: the errors without u and the unmeasured errors that act on the three components
  // of the position.
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::count(names.begin(), names.end(), name) == 1;
  };
  EXPECT_TRUE(has(mean->no_u, "EYX") && has(mean->no_u, "EXZ"));
  EXPECT_TRUE(has(mean->not_measured, "EZX") && has(mean->not_measured, "EXX"));
  EXPECT_FALSE(has(mean->not_measured, "EYX"));
}

TEST(PlaneMapEdges, ExtremeHasTheLargestSize) {
  MapExtremes extremes;
  for (const double e : {1.0, -5.0, 4.0, 5.0, -2.0}) {
    PlanePoint point;
    point.u.setConstant(e + 10);
    point.error.setConstant(e);
    point.error[2] = -e;
    extremes.add(point);
  }
  const MapExtreme first = extremes.found()[0];
  EXPECT_EQ(first.point, 1u);  // the first of two points with equal size
  EXPECT_EQ(first.value, -5);
  EXPECT_EQ(first.range, 10);
  EXPECT_EQ(first.u, 5);
  EXPECT_EQ(extremes.found()[2].value, 5);
  MapExtremes one;
  one.add({Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()});
  EXPECT_EQ(one.found()[0].value, 1);
  EXPECT_EQ(one.found()[0].range, 0);
}

// The machine has no errors, so the first step leaves no residual.
TEST(CompensatingEdges, PerfectMachineNeedsOneStep) {
  const Machine m = plane_machine();
  const auto found = compensating_command(m, {0.1, 0.2}, MachineApproach::mean);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged);
  EXPECT_EQ(found->steps, 1);
  EXPECT_EQ(found->command, (Command{0.1, 0.2}));
}

// An error with a value at one position has this value at all positions. At other positions the
// result reports the error as beyond its table.
TEST(MachineEdges, OtherPositionsAreBeyondATableOfOnePosition) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  MachineFrame& x =
      machine.frames[static_cast<std::size_t>(machine.find("X") - machine.frames.data())];
  x.error[0] = {{0.01}, {5e-6}, {}, {}, {}};
  for (const double at : {0.0, 0.01, 0.02}) {
    Command command{};
    command[x.direction] = at;
    const ToolError found = tool_error(machine, command, MachineApproach::mean);
    EXPECT_EQ(found.beyond.empty(), at == 0.01) << at;
  }
}

// -0.04 + 0.09 · 6/6 exceeds 0.05 by one rounding step and would be beyond the table.
TEST(PlaneMap, LastStepIsTheEndOfTheRange) {
  const auto at = steps_over({-0.04, 0.05}, 0.015);
  ASSERT_EQ(at.size(), 7u);
  EXPECT_EQ(at.front(), -0.04);
  EXPECT_EQ(at.back(), 0.05);
}

}  // namespace
}  // namespace mdof::algo
