// Compares the effect of temperature on the errors with a separate forward model. This model moves
// all points of a face by the matrix of the body and intersects the face with the line of a probe.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "algo/uncertainty/budget/budget.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using Place = std::array<double, 3>;

double dot(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Coordinates are in the machine axes. The target has the errors of an X axis at the travel d.
struct OwnModel {
  std::vector<Place> at, along;
  std::size_t axis = 0;
  double fixture = 0;  // relative expansion of the fixture
  Place bend{};        // expansion coefficient times temperature gradient, 1/m

  static Place rotated_back(const Errors5& e, const Place& v) {
    const double a = e[2], b = e[3], c = e[4];
    const Place z = {std::cos(c) * v[0] + std::sin(c) * v[1],
                     -std::sin(c) * v[0] + std::cos(c) * v[1], v[2]};
    const Place y = {std::cos(b) * z[0] - std::sin(b) * z[2], z[1],
                     std::sin(b) * z[0] + std::cos(b) * z[2]};
    return {y[0], std::cos(a) * y[1] + std::sin(a) * y[2],
            -std::sin(a) * y[1] + std::cos(a) * y[2]};
  }
  // Original position of the material that the temperature gradient has moved to `now`.
  Place material(const Place& now) const {
    Place r = now;
    for (int i = 0; i < 6; ++i) {
      const double by_g = dot(bend, r), square = dot(r, r);
      for (std::size_t k = 0; k < 3; ++k) r[k] = now[k] - by_g * r[k] + square * bend[k] / 2;
    }
    return r;
  }
  double reading(std::size_t probe, double d, const Errors5& e) const {
    const auto beyond = [&](double s) {
      Place p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = at[probe][k] * (1 + fixture) + s * along[probe][k];
      p[axis] -= d;
      if (axis == 0) p[1] -= e[0], p[2] -= e[1];
      return dot(along[probe], material(rotated_back(e, p))) - dot(along[probe], at[probe]);
    };
    double s = 0;
    for (int i = 0; i < 8; ++i) {
      const double slope = (beyond(s + 1e-6) - beyond(s - 1e-6)) / 2e-6;
      s -= beyond(s) / slope;
    }
    return s;
  }
  double zeroed(std::size_t probe, double d, const Errors5& e) const {
    return reading(probe, d, e) - reading(probe, 0, Errors5{});
  }
};

OwnModel own_x() {
  return {{{.01, 0, 0}, {0, .01, 0}, {0, -.01, 0}, {0, .015, .02}, {.01, .015, .02}},
          {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}}};
}

Errors5 truth(double d) {
  return {1e-6 * std::sin(90 * d), 2e-4 * d, 4e-3 * std::sin(60 * d), 5e-3 * d, -3e-3 * d};
}

// Half the difference between the errors that the solver calculates from the readings of two
// forward models.
std::vector<Errors5> half_difference(const SyntheticRun& synthetic, const OwnModel& plus,
                                     const OwnModel& minus, double scale = 0, double offset_m = 0) {
  std::array<Run, 2> runs;
  for (const int sign : {1, -1}) {
    SyntheticRun one = synthetic;
    const OwnModel nominal = synthetic.rig.axis == Axis::x ? own_x() : plus;
    one.added = [&, sign](std::size_t k, double d, double reading, double) {
      const OwnModel& as_is = sign > 0 ? plus : minus;
      const double true_m = d + sign * (d * scale + offset_m);
      return as_is.zeroed(k, true_m, one.truth(true_m)) - reading;
    };
    runs[sign > 0 ? 0 : 1] = one.measure();
  }
  std::vector<Errors5> half;
  for (std::size_t j = 0; j < runs[0].points.size(); ++j) {
    Errors5& of = half.emplace_back();
    for (std::size_t e = 0; e < kErrorCount; ++e)
      of[e] = (runs[0].points[j].errors.local[e] - runs[1].points[j].errors.local[e]) / 2;
  }
  return half;
}

void expect_parts(const PointShifts& part, const std::vector<Errors5>& own, double relative) {
  ASSERT_EQ(part.size(), own.size());
  Errors5 most{};
  for (const Errors5& of : own)
    for (std::size_t e = 0; e < kErrorCount; ++e) most[e] = std::max(most[e], std::abs(of[e]));
  EXPECT_GT(*std::max_element(most.begin(), most.end()), 1e-9);
  for (std::size_t j = 0; j < own.size(); ++j)
    for (std::size_t e = 0; e < kErrorCount; ++e)
      EXPECT_NEAR(part[j][e], own[j][e], relative * most[e] + 1e-12) << j << " " << e;
}

std::vector<PointShifts> only_parts(const SyntheticRun& synthetic, const std::string& name) {
  const auto all = contributors(synthetic.rig, synthetic.measure());
  EXPECT_TRUE(all) << all.error().message;
  EXPECT_EQ(all->size(), 1u);
  EXPECT_EQ(contributor_text(all->front().name), name);
  return all->front().parts();
}

TEST(Expansion, FixtureExpandsAboutItsOrigin) {
  const Rig rig =
      test::rig_x_with("", "", "[temperature]\nu_fixture_K = 2\nfixture_ppm_per_K = 500\n");
  for (const StatedAt& stated : {kAtFixture, kAtCarriage}) {
    SyntheticRun synthetic{.rig = rig, .stated = stated, .truth = truth};
    OwnModel plus = own_x(), minus = own_x();
    plus.fixture = 1e-3;
    minus.fixture = -1e-3;
    const auto parts = only_parts(synthetic, "fixture: expansion");
    ASSERT_EQ(parts.size(), 1u);
    expect_parts(parts[0], half_difference(synthetic, plus, minus), 2e-4);
  }
}

// The encoder reads d, but the true travel is d (1 + s). The errors of the axis belong to the true
// travel.
TEST(Expansion, ScaleErrorGrowsWithTheTravel) {
  const Rig rig = test::rig_x_with(
      "", "", "[temperature]\nscale_C = 22\nu_scale_K = 0\nscale_ppm_per_K = 500\n");
  for (const StatedAt& stated : {kAtFixture, kAtCarriage}) {
    SyntheticRun synthetic{.rig = rig, .stated = stated, .truth = truth};
    synthetic.targets_m.clear();
    for (int i = 0; i <= 80; ++i) synthetic.targets_m.push_back(i * 0.5e-3);
    const auto parts = only_parts(synthetic, "scale: expansion");
    ASSERT_EQ(parts.size(), 1u);
    expect_parts(parts[0], half_difference(synthetic, own_x(), own_x(), 1e-3), 3e-2);
  }
}

// The encoder reads too little at all targets. The contributor has one part for each target; the
// expected change is the sum of these parts.
TEST(Encoder, WrongPositionHasTheErrorsOfAnotherPosition) {
  const Rig rig = test::rig_x_with("", "", "[encoder]\nu_um = 10\n");
  SyntheticRun synthetic{.rig = rig, .truth = truth};
  synthetic.targets_m.clear();
  for (int i = 0; i <= 80; ++i) synthetic.targets_m.push_back(i * 0.5e-3);
  const auto parts = only_parts(synthetic, "encoder");
  ASSERT_EQ(parts.size(), 81u);
  PointShifts sum = parts[0];
  for (Errors5& each : sum)
    for (double& x : each) x = -x;
  for (std::size_t p = 1; p < parts.size(); ++p)
    for (std::size_t j = 0; j < sum.size(); ++j)
      for (std::size_t e = 0; e < kErrorCount; ++e) sum[j][e] -= parts[p][j][e];
  expect_parts(sum, half_difference(synthetic, own_x(), own_x(), 0, 10e-6), 3e-2);
}

TEST(Expansion, GradientBendsTheSquare) {
  const Rig rig = test::rig_x_with("", "",
                                   "[temperature]\nu_square_gradient_K_per_m = [4, 5, 6]\n"
                                   "square_ppm_per_K = 300\nu_square_ppm_per_K = 400\n");
  SyntheticRun synthetic{.rig = rig};
  const auto parts = only_parts(synthetic, "square: temperature gradient");
  ASSERT_EQ(parts.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    OwnModel plus = own_x(), minus = own_x();
    plus.bend[c] = 500e-6 * static_cast<double>(4 + c);
    minus.bend[c] = -plus.bend[c];
    expect_parts(parts[c], half_difference(synthetic, plus, minus), 2e-3);
  }
}

// Along Y, local x is Y and local y is -X.
TEST(Expansion, GradientIsAlongTheMachineAxes) {
  std::string toml = "name = \"y\"\naxis = \"Y\"\n";
  const OwnModel own{{{0, .01, 0}, {-.01, 0, 0}, {.01, 0, 0}, {-.015, 0, .02}, {-.015, .01, .02}},
                     {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {-1, 0, 0}, {-1, 0, 0}},
                     1};
  const char* const names[] = {"A", "B", "C", "D", "E"};
  for (std::size_t k = 0; k < 5; ++k) {
    toml += "[[probe]]\nid = \"" + std::string(names[k]) + "\"\nrange_um = 200\nmeasures = \"" +
            (k < 3 ? "+Z" : "-X") + "\"\nposition_mm = [" + std::to_string(own.at[k][0] * 1e3) +
            ", " + std::to_string(own.at[k][1] * 1e3) + ", " + std::to_string(own.at[k][2] * 1e3) +
            "]\n";
  }
  toml += "[temperature]\nu_square_gradient_K_per_m = [4, 0, 6]\nsquare_ppm_per_K = 500\n";
  SyntheticRun synthetic{.rig = parse_rig(toml, "y.toml").value()};
  const auto parts = only_parts(synthetic, "square: temperature gradient");
  ASSERT_EQ(parts.size(), 2u);  // two directions; the rig declares no gradient along Y
  for (std::size_t i = 0; i < 2; ++i) {
    OwnModel plus = own, minus = own;
    plus.bend[2 * i] = i == 0 ? 2e-3 : 3e-3;
    minus.bend[2 * i] = -plus.bend[2 * i];
    expect_parts(parts[i], half_difference(synthetic, plus, minus), 2e-3);
  }
}

// Over the travel D, a beam with the temperature gradient g has a bow of α g D²/8: 11.5e-6 · 20 ·
// 0.04²/8 = 46 nm.
TEST(Expansion, GradientGivesTheBowOfABeam) {
  const Rig rig = test::rig_x_with("", "",
                                   "[temperature]\nu_square_gradient_K_per_m = [0, 20, 0]\n"
                                   "square_ppm_per_K = 11.5\n");
  const auto parts = only_parts({.rig = rig}, "square: temperature gradient");
  const auto& p = parts.at(0);
  EXPECT_NEAR(std::abs(p[4][kDy] - (p[0][kDy] + p[8][kDy]) / 2), 46e-9, 1e-11);
}

// Expected: the root mean square of the product of temperature difference and expansion
// coefficient, from random draws.
TEST(Expansion, UncorrectedExpansionContributesItsWholeEffect) {
  const Rig rig = test::rig_x_with("", "",
                                   "[temperature]\nscale_C = 23\nu_scale_K = 2\n"
                                   "scale_ppm_per_K = 8\nu_scale_ppm_per_K = 3\n");
  std::mt19937_64 engine(7);
  std::normal_distribution<> per_K(8e-6, 3e-6), above(3, 2);
  double sum = 0;
  constexpr int kDraws = 400'000;
  for (int i = 0; i < kDraws; ++i) sum += std::pow(per_K(engine) * above(engine), 2);
  EXPECT_NEAR(rig.expansion.scale.relative() / std::sqrt(sum / kDraws), 1, 0.01);
}

}  // namespace
}  // namespace mdof::algo
