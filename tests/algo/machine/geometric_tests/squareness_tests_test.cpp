#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "algo/machine/geometric_tests/diagonal.h"

namespace mdof::algo {
namespace {

constexpr int kSimulations = 2000;

// Sum of twelve uniform numbers, nearly a normal number.
double noise(std::mt19937& source) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(source()) / 4294967296.0;
  return sum;
}

// Lengths of the two sides and of the diagonals of a plane whose axes enclose 90° + error; each
// line is measured n times.
DiagonalLines measured_lines(double error, std::mt19937& source, std::size_t n, bool two,
                             double noise_m, double scale = 1) {
  const double x = 0.4, y = 0.3, lean = std::sin(error), up = std::cos(error);
  const double length[] = {x, y, std::hypot(x - y * lean, y * up),
                           std::hypot(x + y * lean, y * up)};
  DiagonalLines lines;
  MeasuredLine* of[] = {&lines.first, &lines.second, &lines.diagonal, &lines.other};
  for (std::size_t i = 0; i < (two ? 4u : 3u); ++i)
    for (std::size_t k = 0; k < n; ++k)
      of[i]->length_m.push_back(length[i] * scale + noise_m * noise(source));
  return lines;
}

TEST(Diagonals, GiveTheAngleBetweenTheAxes) {
  std::mt19937 source(1);
  for (const bool two : {false, true})
    for (const double error : {-1e-3, 25e-6, 2e-3}) {
      auto lines = measured_lines(error, source, 1, two, 0, 1 + 20e-6);
      lines.u_line_m = 0.1e-6;
      const auto s = squareness_from_diagonals(lines);
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->angle_error_rad, error, 1e-14);
      EXPECT_EQ(s->two_diagonals, two);
    }
}

// The expected sensitivity to each line is the difference of two results of the formula.
TEST(Diagonals, UncertaintyFollowsFromTheLines) {
  std::mt19937 source(2);
  for (const bool two : {false, true}) {
    auto lines = measured_lines(1e-3, source, 1, two, 0);
    lines.u_line_m = 1e-7;
    const double before = squareness_from_diagonals(lines)->angle_error_rad;
    double squares = 0;
    for (auto* line : {&lines.first, &lines.second, &lines.diagonal, &lines.other}) {
      if (line->length_m.empty()) continue;
      line->length_m[0] += 1e-7;
      squares += std::pow(squareness_from_diagonals(lines)->angle_error_rad - before, 2);
      line->length_m[0] -= 1e-7;
    }
    EXPECT_NEAR(squareness_from_diagonals(lines)->u_rad, std::sqrt(squares), 1e-6 * 1e-6);
  }
}

// Required: the intervals of 94 to 96.5 % of 2,000 simulations contain the truth.
TEST(Diagonals, IntervalsCoverTheTruth) {
  for (const bool two : {false, true}) {
    std::mt19937 source(3);
    int covered = 0;
    for (int i = 0; i < kSimulations; ++i) {
      const double error = 50e-6 * noise(source);
      const auto s = squareness_from_diagonals(measured_lines(error, source, 6, two, 0.2e-6));
      covered += std::abs(s->angle_error_rad - error) <= s->U_rad ? 1 : 0;
    }
    EXPECT_GE(covered, 0.94 * kSimulations);
    EXPECT_LE(covered, 0.965 * kSimulations);
  }
}

// A line that was read once has the noise of the lines that were read more often. If all lines were
// read once, the declared u applies. Required share as above.
TEST(Diagonals, IntervalsCoverTheTruthForLinesReadOnce) {
  const std::vector<std::array<std::size_t, 4>> counts = {{1, 1, 6, 0}, {6, 1, 1, 0}, {2, 1, 3, 0},
                                                          {1, 1, 1, 5}, {1, 1, 2, 2}, {1, 1, 1, 1}};
  for (const auto& n : counts) {
    std::mt19937 source(9);
    int covered = 0;
    for (int i = 0; i < kSimulations; ++i) {
      const double error = 50e-6 * noise(source);
      auto lines = measured_lines(error, source, 6, n[3] > 0, 0.2e-6);
      lines.first.length_m.resize(n[0]);
      lines.second.length_m.resize(n[1]);
      lines.diagonal.length_m.resize(n[2]);
      lines.other.length_m.resize(n[3]);
      if (n[2] == 1 && n[3] == 1) lines.u_line_m = 0.2e-6;
      const auto s = squareness_from_diagonals(lines);
      ASSERT_TRUE(s) << s.error().message;
      covered += std::abs(s->angle_error_rad - error) <= s->U_rad ? 1 : 0;
    }
    EXPECT_GE(covered, 0.94 * kSimulations) << n[0] << n[1] << n[2] << n[3];
    EXPECT_LE(covered, 0.965 * kSimulations) << n[0] << n[1] << n[2] << n[3];
  }
}

TEST(Diagonals, RefuseLinesWithoutATriangle) {
  std::mt19937 source(4);
  auto lines = measured_lines(0, source, 2, false, 1e-7);
  EXPECT_TRUE(squareness_from_diagonals(lines));
  lines.diagonal.length_m[1] = 0.5e3;
  EXPECT_FALSE(squareness_from_diagonals(lines));
  lines.diagonal.length_m[1] = NAN;
  EXPECT_FALSE(squareness_from_diagonals(lines));
  lines.diagonal.length_m.clear();
  EXPECT_FALSE(squareness_from_diagonals(lines));
  EXPECT_FALSE(squareness_from_diagonals(measured_lines(0, source, 1, false, 0)));
}

// A machine whose Y axis is not square to X. Its diagonals differ by the law of cosines.
TEST(Diagonals, PredictedDiagonalsGiveTheSameSign) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  for (auto& f : m.frames) f.kind = FrameKind::linear;
  m.frames[0].range = {0, 0.4};
  m.frames[1].range = {0, 0.3};
  m.frames[1].location[5].value = 30e-6;
  const auto d = plane_diagonals(m, 0, 1, 10, MachineApproach::mean);
  ASSERT_TRUE(d);
  EXPECT_EQ((*d)[0].name, "X+Y+");
  EXPECT_EQ((*d)[1].name, "X-Y+");
  EXPECT_NEAR((*d)[0].position_m.back(), 0.5, 1e-15);
  DiagonalLines lines{{{0.4}},
                      {{0.3}},
                      {{0.5 + (*d)[0].deviation_m.back()}},
                      {{0.5 + (*d)[1].deviation_m.back()}},
                      1e-7};
  EXPECT_NEAR(squareness_from_diagonals(lines)->angle_error_rad, 30e-6, 1e-9);
  EXPECT_GT((*d)[1].deviation_m.back(), 0);
  EXPECT_NEAR((*d)[1].range_m, (*d)[1].deviation_m.back(), 1e-15);
}

// No corner of the range is at the zeros of the axes. Both diagonals must begin and end at the
// corners.
TEST(Diagonals, GoFromCornerToCorner) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  for (auto& f : m.frames) f.kind = FrameKind::linear;
  m.frames[0].range = {-0.1, 0.2};
  m.frames[1].range = {0.05, 0.45};
  // EYY increases with Y: 5 µm at Y = 0.05 m, 45 µm at Y = 0.45 m. The deviation along a diagonal
  // of 0.5 m is 4/5 of EYY.
  m.frames[1].error[1] = {{0.05, 0.45}, {5e-6, 45e-6}, {}, {}, {}};
  const auto d = plane_diagonals(m, 0, 1, 4, MachineApproach::forward);
  ASSERT_TRUE(d) << d.error().message;
  for (const Diagonal& one : *d) {
    ASSERT_EQ(one.position_m.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(one.position_m[i], 0.125 * static_cast<double>(i), 1e-15);
      EXPECT_NEAR(one.deviation_m[i], 8e-6 * static_cast<double>(i), 1e-15);
    }
    EXPECT_NEAR(one.range_m, 32e-6, 1e-15);
    EXPECT_TRUE(one.beyond.empty());
  }
  const auto none = plane_diagonals(m, 0, 2, 4, MachineApproach::mean);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no axis Z"), std::string::npos);
}

TEST(PlaneMap, CoversTheRangeUpToAMillionPoints) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  for (auto& f : m.frames) f.kind = FrameKind::linear;
  m.frames[0].range = {-0.1, 0.2};
  m.frames[1].range = {0.05, 0.45};
  m.frames[0].error[1] = {{-0.1, 0.2}, {-3e-6, 6e-6}, {}, {}, {}};
  PlaneMapRequest request;
  request.step_m = 0.1;
  const auto map = plane_map(m, request);
  ASSERT_TRUE(map) << map.error().message;
  ASSERT_EQ(map->first_m.size(), 4U);
  ASSERT_EQ(map->second_m.size(), 5U);
  ASSERT_EQ(map->points.size(), 20U);
  EXPECT_NEAR(map->first_m[1], 0, 1e-15);
  EXPECT_NEAR(map->second_m[4], 0.45, 1e-15);
  EXPECT_EQ(map->first_at(6), map->first_m[2]);  // the first axis has the smallest stride
  EXPECT_EQ(map->second_at(6), map->second_m[1]);
  EXPECT_NEAR(map->points[6].error[1], 3e-6, 1e-15);
  const MapExtreme extreme = map->extremes[1];
  request.extremes_only = true;
  const auto without_points = plane_map(m, request);
  EXPECT_TRUE(without_points->points.empty());
  EXPECT_EQ(without_points->extremes[1].value, extreme.value);
  EXPECT_EQ(without_points->extremes[1].point, extreme.point);
  request.extremes_only = false;
  EXPECT_NEAR(extreme.value, 6e-6, 1e-15);
  EXPECT_EQ(extreme.point % 4, 3U);  // point 3 of a row, in any row
  EXPECT_NEAR(extreme.range, 9e-6, 1e-15);
  // With 999 steps on each side the map has a million points. plane_map() refuses such a map before
  // the calculation.
  m.frames[0].range = m.frames[1].range = {-0.25, 0.75};
  request.step_m = 1 / 998.5;
  const auto refused = plane_map(m, request);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("a million points"), std::string::npos);
  request.step_m = 0.2;
  EXPECT_EQ(plane_map(m, request)->points.size(), 36U);
}

// EXX is curved along X. At a quarter of the travel it is below the values at the ends, at three
// quarters above.
TEST(Diagonals, RangeIsHighestMinusLowest) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  for (auto& f : m.frames) f.kind = FrameKind::linear;
  m.frames[0].range = {0, 0.3};
  m.frames[1].range = {0, 0.4};
  m.frames[0].error[0] = {{0, 0.075, 0.225, 0.3}, {0, -5e-6, 10e-6, 0}, {}, {}, {}};
  const auto d = plane_diagonals(m, 0, 1, 4, MachineApproach::mean);
  ASSERT_TRUE(d) << d.error().message;
  EXPECT_NEAR((*d)[0].deviation_m[1], -3e-6, 1e-15);  // a change of X changes the diagonal by 3/5
  EXPECT_NEAR((*d)[0].deviation_m[3], 6e-6, 1e-15);
  EXPECT_NEAR((*d)[0].range_m, 9e-6, 1e-15);
}

// u from repeated readings and declared u are stated separately. Each line contributes its own
// degrees of freedom.
TEST(Diagonals, CombineRepeatedAndDeclaredUncertainty) {
  DiagonalLines lines{{{0.4 - 1e-6, 0.4 + 1e-6}},
                      {{0.3 - 3e-6, 0.3 + 3e-6}},
                      {{0.5 - 2e-6, 0.5, 0.5 + 2e-6}},
                      {},
                      0};
  const auto repeated_only = squareness_from_diagonals(lines);
  ASSERT_TRUE(repeated_only) << repeated_only.error().message;
  // The angle follows from cos = (d² - x² - y²) / 2xy. At a right angle ∂/∂d = d/xy, ∂/∂x = -1/y,
  // ∂/∂y = -1/x.
  const double of_x = 1e-6 / 0.3, of_y = 3e-6 / 0.4, of_d = 2e-6 / std::sqrt(3) * 0.5 / 0.12;
  const double u = std::hypot(of_x, of_y, of_d);
  EXPECT_NEAR(repeated_only->u_repeat_rad, u, 1e-11);
  EXPECT_NEAR(repeated_only->u_rad, repeated_only->u_repeat_rad, 1e-15);
  const double fourths = std::pow(of_x, 4) + std::pow(of_y, 4) + std::pow(of_d, 4) / 2;
  EXPECT_NEAR(repeated_only->freedom, std::pow(u, 4) / fourths, 1e-4);
  // Y was read once. The pooled s² of all lines is (2 + 8) 1e-12 / 3. It applies to the means of
  // two readings (x), one reading (y) and three readings (d).
  DiagonalLines once = lines;
  once.second.length_m = {0.3};
  const auto pooled = squareness_from_diagonals(once);
  const double s = std::sqrt(10e-12 / 3);
  EXPECT_NEAR(pooled->u_rad, s * std::sqrt(1 / 0.09 / 2 + 1 / 0.16 + 0.25 / 0.0144 / 3), 1e-11);
  EXPECT_NEAR(pooled->freedom, 3, 1e-9);
  EXPECT_NEAR(repeated_only->U_rad, repeated_only->k * repeated_only->u_rad, 1e-18);
  lines.u_line_m = 1e-6;
  const auto both = squareness_from_diagonals(lines);
  const double declared = 1e-6 * std::sqrt(1 / 0.09 + 1 / 0.16 + 0.25 / 0.0144);
  EXPECT_NEAR(both->u_repeat_rad, repeated_only->u_repeat_rad, 1e-15);
  EXPECT_NEAR(both->u_rad, std::hypot(declared, repeated_only->u_rad), 1e-11);
}

}  // namespace
}  // namespace mdof::algo
