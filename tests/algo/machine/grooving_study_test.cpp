// The study is compared with a machine that this file calculates separately: small angles, levers
// by hand, no kinematic chain.
#include "algo/machine/study/grooving_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "algo/compensation/volumetric/volumetric.h"

namespace mdof::algo {
namespace {

constexpr double kWidth = 0.4, kMiddle = 0.2, kHeight = 0.12, kArm = 0.15;
constexpr double kRounding = 3e-10;  // second-order terms: 10 µm at 25 µrad
// Negligible noise. Without any noise, no uncertainty could be stated.
constexpr GroovingInstruments kQuiet = {1e-15, 1e-15, 1e-15, 1e-15, 1e-15, 2};

double between(const ErrorFunction& f, double at) {
  if (f.position.empty()) return f.forward.at(0);
  std::size_t i = 1;
  while (i + 1 < f.position.size() && f.position[i] < at) ++i;
  const double part = (at - f.position[i - 1]) / (f.position[i] - f.position[i - 1]);
  return f.forward[i - 1] + part * (f.forward[i] - f.forward[i - 1]);
}

using Three = std::array<double, 3>;

// Y carries the work and moves against its command. X carries the tool, 120 mm above both guides.
// The reference point of the errors of X moves with the carriage of X. The reference point of the
// errors of Y is fixed to the bed, in the middle of the travel of X.
struct ByHand {
  Machine machine = grooving_machine();
  const MachineFrame& x = *machine.find("X");
  const MachineFrame& y = *machine.find("Y");
  const MachineFrame& c = *machine.find("C");

  Three error(double at_x, double at_y) const {
    const auto e = [&](std::size_t k) { return between(x.error[k], at_x); };
    const auto f = [&](std::size_t k) { return between(y.error[k], at_y); };
    const double lever = at_x - kMiddle;
    return {e(0) + e(4) * kHeight - (f(0) + f(4) * kHeight),
            e(1) - e(3) * kHeight + *x.location[5].value * at_x -
                (f(1) - f(3) * kHeight + f(5) * lever),
            e(2) - (f(2) - f(4) * lever)};
  }
  Three corrected(const VolumetricTable& table, double at_x, double at_y) const {
    const auto by = volumetric_at(table, {at_x, at_y, 0}).correction_m;
    Three e = error(at_x + by[0], at_y + by[1]);
    for (std::size_t k = 0; k < 3; ++k) e[k] += by[k];
    return e;
  }
};

using ErrorAt = std::function<Three(double, double)>;

std::vector<double> nodes(std::size_t steps) {
  std::vector<double> at;
  for (std::size_t i = 0; i <= steps; ++i)
    at.push_back(kWidth * static_cast<double>(i) / static_cast<double>(steps));
  return at;
}

double range(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end()) -
         *std::min_element(values.begin(), values.end());
}

// Readings of two lasers and of a square, and the errors that Eq. 1 calculates from them.
struct Seen {
  std::vector<double> at = nodes(40), along_x, beside_x, along_y, beside_y;
  double slopes = 0;

  explicit Seen(const ErrorAt& error) {
    for (const double p : at) {
      const Three x = error(p, kMiddle), y = error(kMiddle, p);
      along_x.push_back(x[0] - error(0, kMiddle)[0]);
      beside_x.push_back(x[1]);
      along_y.push_back(y[1] - error(kMiddle, 0)[1]);
      beside_y.push_back(y[0]);
    }
    for (auto* beside : {&beside_x, &beside_y}) {
      const double first = beside->front(), slope = (beside->back() - first) / kWidth;
      slopes += slope;
      for (std::size_t i = 0; i < at.size(); ++i) (*beside)[i] -= first + slope * at[i];
    }
  }
  // The axis line of X is turned by 90° minus the angle between the axes.
  Three by_equation_1(std::size_t i, std::size_t j) const {
    return {along_x[i] + beside_y[j], beside_x[i] + along_y[j] + slopes * at[i], 0};
  }
};

void compare(const GroovingState& state, const ErrorAt& error) {
  const Seen seen(error);
  EXPECT_NEAR(state.angle_error_rad, -seen.slopes, 1e-9);
  const MachineFrame &x = *state.found.find("X"), &y = *state.found.find("Y");
  EXPECT_NEAR(*x.location[5].value, seen.slopes, 1e-9);
  EXPECT_FALSE(y.location[5].value);
  EXPECT_FALSE(x.error[2].known() || x.error[3].known() || y.error[5].known());
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    EXPECT_NEAR(x.error[0].position[i], seen.at[i], 1e-12);
    EXPECT_NEAR(x.error[0].forward[i], seen.along_x[i], kRounding);
    EXPECT_NEAR(x.error[1].forward[i], seen.beside_x[i], kRounding);
    EXPECT_NEAR(y.error[0].forward[i], -seen.beside_y[i], kRounding);
    EXPECT_NEAR(y.error[1].forward[i], -seen.along_y[i], kRounding);
  }
  std::array<std::vector<double>, 2> estimated, actual;
  for (std::size_t i = 0; i < seen.at.size(); ++i)
    for (std::size_t j = 0; j < seen.at.size(); ++j)
      for (std::size_t k = 0; k < 2; ++k) {
        estimated[k].push_back(seen.by_equation_1(i, j)[k]);
        actual[k].push_back(error(seen.at[i], seen.at[j])[k]);
      }
  EXPECT_NEAR(state.estimated.x_m, range(estimated[0]), kRounding);
  EXPECT_NEAR(state.estimated.y_m, range(estimated[1]), kRounding);
  EXPECT_NEAR(state.actual.x_m, range(actual[0]), kRounding);
  EXPECT_NEAR(state.actual.y_m, range(actual[1]), kRounding);
  // Squared distance between two actual tool positions, for the law of cosines.
  const auto square = [&](double x0, double y0, double x1, double y1) {
    const Three a = error(x0, y0), b = error(x1, y1);
    return std::pow(x1 + b[0] - x0 - a[0], 2) + std::pow(y1 + b[1] - y0 - a[1], 2) +
           std::pow(b[2] - a[2], 2);
  };
  const double px = square(0, kMiddle, kWidth, kMiddle), py = square(kMiddle, 0, kMiddle, kWidth);
  const double pd = square(0, 0, kWidth, kWidth), pe = square(kWidth, 0, 0, kWidth);
  EXPECT_NEAR(state.square.angle_error_rad, (pe - pd) / (4 * std::sqrt(px * py)), 1e-9);
  EXPECT_NEAR(state.one_diagonal_angle_rad, (px + py - pd) / (2 * std::sqrt(px * py)), 1e-9);
  ASSERT_EQ(state.diagonals.size(), 2U);
  for (const DiagonalRange& diagonal : state.diagonals) {
    const bool falls = diagonal.name == "X-Y+";
    EXPECT_TRUE(falls || diagonal.name == "X+Y+");
    std::vector<double> predicted, measured;
    double most = 0;
    for (std::size_t i = 0; i <= 40; i += 2) {
      const std::size_t at_x = falls ? 40 - i : i;
      const auto along = [&](const Three& e) {
        return ((falls ? -e[0] : e[0]) + e[1]) / std::numbers::sqrt2;
      };
      predicted.push_back(along(seen.by_equation_1(at_x, i)));
      measured.push_back(along(error(seen.at[at_x], seen.at[i])));
      most = std::max(most, std::abs(measured.back() - measured.front() - predicted.back() +
                                     predicted.front()));
    }
    EXPECT_NEAR(diagonal.predicted_m, range(predicted), kRounding);
    EXPECT_NEAR(diagonal.measured_m, range(measured), kRounding);
    EXPECT_NEAR(diagonal.difference_m, most, kRounding);
  }
}

TEST(GroovingStudy, PlaneMatchesTheCalculationByHand) {
  const ByHand hand;
  const auto study = grooving_study(5, kQuiet);
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_EQ(study->seed, 5U);
  EXPECT_EQ(study->instruments.repeats, kQuiet.repeats);
  compare(study->before, [&](double x, double y) { return hand.error(x, y); });
  compare(study->after,
          [&](double x, double y) { return hand.corrected(study->corrections, x, y); });
  // At the nodes of the grid of 20 mm, the corrections cancel the errors by Eq. 1.
  const Seen seen([&](double x, double y) { return hand.error(x, y); });
  EXPECT_EQ(study->corrections.command_m[0].size(), 21U);
  for (const std::size_t i : {0U, 4U, 26U, 40U})
    for (const std::size_t j : {0U, 14U, 40U}) {
      const auto by = volumetric_at(study->corrections, {seen.at[i], seen.at[j], 0});
      const Three e = seen.by_equation_1(i, j);
      EXPECT_NEAR(by.correction_m[0], -e[0], 2e-9);  // the error applies at the corrected command
      EXPECT_NEAR(by.correction_m[1], -e[1], 2e-9);
      EXPECT_EQ(by.correction_m[2], 0);
    }
}

// The expected first harmonic over 72 equal angles comes from Fourier sums.
TEST(GroovingStudy, TableMatchesTheCalculationByHand) {
  const ByHand hand;
  const auto study = grooving_study(5, kQuiet);
  ASSERT_TRUE(study) << study.error().message;
  const GroovingTable& table = study->table;
  const double a0 = *hand.c.location[3].value, b0 = *hand.c.location[4].value;
  EXPECT_EQ(table.EA0C_rad, a0);
  EXPECT_EQ(table.EB0C_rad, b0);
  EXPECT_EQ(table.radius_m, kArm);
  std::array<std::vector<double>, 3> height;  // as read; without tilt; without tilt and axes
  std::vector<double> left;
  std::array<double, 3> a{}, b{};
  constexpr std::size_t kCount = 72;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCount;
    const double s = kArm * std::sin(angle), c = kArm * std::cos(angle);
    const double x = kMiddle + c, y = kMiddle + s;
    const double tilt = between(hand.c.error[3], angle) * s - between(hand.c.error[4], angle) * c;
    const double off = -hand.error(x, y)[2];
    // Indicators along X and Y are read every 10 mm from 0 on.
    const auto along = [&](bool is_x, double at) {
      const auto z = [&](double p) {
        return is_x ? hand.error(p, kMiddle)[2] : hand.error(kMiddle, p)[2];
      };
      const double below = 0.01 * std::floor(at / 0.01 + 1e-9), part = (at - below) / 0.01;
      return z(below) + part * (z(std::min(below + 0.01, kWidth)) - z(below)) - z(0);
    };
    height[0].push_back(off + a0 * s - b0 * c + tilt);
    height[1].push_back(height[0].back() - tilt);
    height[2].push_back(height[1].back() + along(true, x) + along(false, y));
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] += 2 * height[k].back() * s / (kArm * kArm * kCount);
      b[k] -= 2 * height[k].back() * c / (kArm * kArm * kCount);
    }
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCount;
    left.push_back(height[1][i] - kArm * (a[2] * std::sin(angle) - b[2] * std::cos(angle)));
  }
  const std::array<const Perpendicularity*, 3> found = {&table.raw, &table.without_tilt,
                                                        &table.without_both};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found[k]->EA0C_rad, a[k], 2e-10) << k;
    EXPECT_NEAR(found[k]->EB0C_rad, b[k], 2e-10) << k;
    EXPECT_EQ(found[k]->harmonics.size(), 5U);
    EXPECT_EQ(found[k]->tilt_known, k > 0);
    EXPECT_EQ(found[k]->axes_known, k == 2);
  }
  EXPECT_NEAR(table.range_m, range(height[0]), kRounding);
  EXPECT_NEAR(table.range_without_tilt_m, range(height[1]), kRounding);
  EXPECT_NEAR(table.range_left_m, range(left), kRounding);
}

double rms(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

// One instrument at a time has noise. Results that do not use this instrument must not change.
TEST(GroovingStudy, TheNoiseOfEachInstrumentIsInWhatItReads) {
  const auto quiet = grooving_study(1, kQuiet);
  ASSERT_TRUE(quiet);
  struct Off {
    std::vector<double> readings, first, angle, one_diagonal, both, along, raw, tilted, axes;
  };
  const auto off = [&](const GroovingInstruments& by, std::uint64_t seeds) {
    Off all;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto study = grooving_study(seed, by);
      const GroovingState &s = study->before, &q = quiet->before;
      const MachineFrame &x = *s.found.find("X"), &qx = *q.found.find("X");
      for (std::size_t i = 1; i < x.error[0].position.size(); ++i)
        all.readings.push_back(x.error[0].forward[i] - qx.error[0].forward[i]);
      all.first.push_back(x.error[0].forward[0]);
      all.angle.push_back(s.angle_error_rad - q.angle_error_rad);
      all.both.push_back(s.square.angle_error_rad - q.square.angle_error_rad);
      all.one_diagonal.push_back(s.one_diagonal_angle_rad - q.one_diagonal_angle_rad);
      all.along.push_back(s.diagonals[0].measured_m - q.diagonals[0].measured_m);
      all.raw.push_back(study->table.raw.EA0C_rad - quiet->table.raw.EA0C_rad);
      all.tilted.push_back(study->table.without_tilt.EB0C_rad - quiet->table.without_tilt.EB0C_rad);
      all.axes.push_back(study->table.without_both.EA0C_rad - quiet->table.without_both.EA0C_rad);
    }
    return all;
  };
  constexpr double kStill = 1e-13;
  GroovingInstruments by = kQuiet;
  by.repeats = 4;
  by.position_m = 100e-9;  // u of the mean of four is 50 nm; the reference at 0 has the same noise
  const Off laser = off(by, 8);
  EXPECT_NEAR(rms(laser.readings), 50e-9 * std::sqrt(2), 20e-9);
  EXPECT_EQ(rms(laser.first), 0);
  EXPECT_GT(rms(laser.along), 5e-9);
  EXPECT_LT(rms(laser.raw) + rms(laser.both), kStill);
  const auto one = grooving_study(1, by);
  EXPECT_DOUBLE_EQ(one->before.found.find("Y")->error[1].u[7], 50e-9);
  by.square_rad = 0.2e-6;
  EXPECT_NEAR(grooving_study(1, by)->before.u_angle_rad, std::hypot(0.2e-6, 2 * 50e-9 / kWidth),
              1e-15);

  by = kQuiet;
  by.square_rad = 1e-6;  // one square, also for several repeats
  const Off square = off(by, 30);
  EXPECT_NEAR(rms(square.angle), 1e-6, 0.35e-6);
  EXPECT_LT(rms(square.readings) + rms(square.both) + rms(square.raw), kStill);

  by = kQuiet;
  by.repeats = 9;
  by.line_m = 900e-9;  // u of the mean of nine is 300 nm; two diagonals of 4 · 400 mm · sin 45°
  const Off lines = off(by, 30);
  EXPECT_NEAR(rms(lines.both), 300e-9 / kWidth, 0.3 * 300e-9 / kWidth);
  EXPECT_NEAR(rms(lines.one_diagonal), 300e-9 * 2 / kWidth, 0.3 * 300e-9 * 2 / kWidth);
  EXPECT_LT(rms(lines.readings) + rms(lines.angle) + rms(lines.raw), kStill);

  by = kQuiet;
  by.height_m = 60e-9;  // noise of each of 72 angles, read once: √(2/72)/r
  const Off indicator = off(by, 30);
  const double u = 60e-9 * std::sqrt(2. / 72) / kArm;
  EXPECT_NEAR(rms(indicator.raw), u, 0.35 * u);
  EXPECT_GT(rms(indicator.axes),
            1.2 * rms(indicator.raw));  // the heights along the axes also have noise
  EXPECT_LT(rms(indicator.readings) + rms(indicator.angle) + rms(indicator.both), kStill);

  by = kQuiet;
  by.tilt_rad = 1e-6;  // acts with the lever, twice: √((3/4 + 1/4) · 2/72)
  const Off level = off(by, 30);
  EXPECT_LT(rms(level.raw) + rms(level.readings), kStill);
  EXPECT_NEAR(rms(level.tilted), 1e-6 * std::sqrt(2. / 72), 0.35e-6 * std::sqrt(2. / 72));

  // The defaults in the header are 50 nm, 0.3 µrad, 100 nm, 20 nm and 0.1 µrad, with five repeats
  // each.
  const Off typical = off({}, 30);
  const double rms_from_lines = 100e-9 / std::sqrt(5.) / kWidth;
  const double rms_from_heights = 20e-9 / kArm * std::sqrt(2. / 72);
  EXPECT_NEAR(rms(typical.both), rms_from_lines, 0.35 * rms_from_lines);
  EXPECT_NEAR(rms(typical.raw), rms_from_heights, 0.35 * rms_from_heights);
  const double with_level = std::hypot(rms_from_heights, 0.1e-6 * std::sqrt(2. / 72));
  EXPECT_NEAR(rms(typical.tilted), with_level, 0.35 * with_level);
  EXPECT_NEAR(grooving_study(1, {})->before.u_angle_rad,
              std::hypot(0.3e-6, 2 * 50e-9 / std::sqrt(5.) / kWidth), 1e-15);
}

// The machine of the paper has 11.59, 12.33 and 17.3 µm before the corrections.
TEST(GroovingStudy, MachineIsCloseToThatOfThePaper) {
  const auto study = grooving_study(1, kQuiet);
  ASSERT_TRUE(study);
  EXPECT_NEAR(study->before.estimated.x_m, 11.59e-6, 0.25e-6);
  EXPECT_NEAR(study->before.estimated.y_m, 12.33e-6, 0.25e-6);
  double most = 0;
  for (const DiagonalRange& d : study->before.diagonals) most = std::max(most, d.measured_m);
  EXPECT_NEAR(most, 17.3e-6, 0.6e-6);
  EXPECT_NE(grooving_study(2, {})->before.angle_error_rad,
            grooving_study(3, {})->before.angle_error_rad);
  const Machine machine = grooving_machine();
  EXPECT_TRUE(machine.simulated);
  for (const MachineFrame& frame : machine.frames)
    for (std::size_t k = 0; k < kBodyErrors; ++k) EXPECT_TRUE(frame.error[k].known());
}

// The errors of the machine for which README and CAMPAIGNS state results. An error is a slope over
// the travel plus waves; each wave has a size, a length (m, or turns of a circle) and a phase
// (turns).
struct Shape {
  std::string axis;
  std::size_t k;
  double slope;
  std::vector<Three> waves;
};
TEST(GroovingStudy, MachineHasTheDocumentedErrors) {
  const Machine machine = grooving_machine();
  const Shape shapes[] = {{"X", 0, 9.7e-6, {{0.5e-6, 0.19, 0.2}}},
                          {"X", 1, 0, {{0.8e-6, 0.41, 0.1}, {0.12e-6, 0.13, 0.4}}},
                          {"X", 2, 0, {{0.3e-6, 0.3, 0.3}}},
                          {"X", 3, 0, {{1e-6, 0.35, 0}}},
                          {"X", 4, 0, {{1.2e-6, 0.35, 0.3}}},
                          {"X", 5, 0, {{1.5e-6, 0.35, 0.6}}},
                          {"Y", 0, 0, {{0.9e-6, 0.43, 0.35}, {0.1e-6, 0.12, 0.1}}},
                          {"Y", 1, -4.6e-6, {{0.45e-6, 0.17, 0.6}}},
                          {"Y", 2, 0, {{0.25e-6, 0.28, 0.15}}},
                          {"Y", 3, 0, {{0.9e-6, 0.37, 0.2}}},
                          {"Y", 4, 0, {{0.8e-6, 0.4, 0.5}}},
                          {"Y", 5, 0, {{2.6e-6, 0.4, 0.75}}},
                          {"C", 3, 0, {{1.5e-6, 0.5, 0.6}, {0.4e-6, 1. / 3, 0}}},
                          {"C", 4, 0, {{1.2e-6, 0.5, 0.35}, {0.5e-6, 1. / 3, 0.2}}}};
  for (const Shape& shape : shapes) {
    const bool turns = shape.axis == "C";
    const ErrorFunction& f = machine.find(shape.axis)->error[shape.k];
    ASSERT_EQ(f.position.size(), turns ? 361U : 201U);
    for (std::size_t i = 0; i < f.position.size(); ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(f.position.size() - 1);
      double value = shape.slope * (part - 0.5);
      for (const auto& [size, length, phase] : shape.waves)
        value +=
            size * std::sin(2 * std::numbers::pi * (part * (turns ? 1 : kWidth) / length + phase));
      EXPECT_NEAR(f.forward[i], value, 1e-18) << shape.axis << shape.k;
      EXPECT_NEAR(f.position[i], part * (turns ? 2 * std::numbers::pi : kWidth), 1e-12);
    }
  }
  EXPECT_EQ(machine.find("X")->location[5].value, 22.8e-6);
  EXPECT_EQ(machine.find("C")->location[3].value, 12e-6);
  EXPECT_EQ(machine.find("C")->location[4].value, -8e-6);
  EXPECT_EQ(machine.find("Y")->location[5].value, 0);
  EXPECT_EQ(machine.find("C")->at_m, (Vec3{kMiddle, kMiddle, 0}));
  EXPECT_EQ((*machine.find("C")->range)[1], 2 * std::numbers::pi);
  EXPECT_EQ((*machine.find("Y")->range)[1], kWidth);
  EXPECT_EQ((*machine.find("Y")->range)[0], 0);
}

}  // namespace
}  // namespace mdof::algo
