// The circular test is compared with results calculated by hand for one error of the machine at a
// time.
#include "algo/machine/geometric_tests/circle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mdof::algo {
namespace {

constexpr double kCircle_m = 0.02;

Machine flat_machine(const std::string& x, const std::string& y,
                     const std::string& chain = "w-b-X-Y-t") {
  const auto axis = [](const std::string& id, const std::string& errors) {
    return "[[axis]]\nid = \"" + id + "\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n" + errors +
           "\n";
  };
  const auto parsed = parse_machine(
      "name = \"m\"\nmachine = {chain = \"" + chain + "\"}\n" + axis("X", x) + axis("Y", y),
      "m.toml");
  EXPECT_TRUE(parsed) << parsed.error().message;
  return *parsed;
}

PredictedCircle predicted(const Machine& machine, std::size_t angles = 360) {
  CircleRequest request;
  request.centre = {0.05, 0.04};
  request.radius_m = kCircle_m;
  request.angles = angles;
  const auto circle = predicted_circle(machine, request);
  EXPECT_TRUE(circle) << circle.error().message;
  return *circle;
}

CircularFigures figures(const Machine& machine) {
  const auto found = circular_figures(predicted(machine).path);
  EXPECT_TRUE(found) << found.error().message;
  return *found;
}

TEST(CircularTest, PerfectMachineHasNoDeviations) {
  const CircularFigures f = figures(flat_machine("", ""));
  for (const double figure : {f.G_ccw_m, f.G_cw_m, f.Gb_m, f.H_m, f.D_m, f.F_ccw_m[0], f.F_cw_m[1]})
    EXPECT_NEAR(figure, 0, 1e-12);
}

// The rotary axis A between Y and Z turns Z to Y: for A = 30 degrees, the circle of the commands is
// an ellipse with the semi-axes R sqrt(1 + sin 30°) and R sqrt(1 - sin 30°).
TEST(CircularTest, RefusesAnObliqueRotaryAxis) {
  const auto parsed = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-Y-A-b-X-Z-t\"}\n"
      "[[axis]]\nid = \"Y\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n"
      "[[axis]]\nid = \"A\"\ncentre_mm = [0, 0, 0]\n"
      "[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n"
      "[[axis]]\nid = \"Z\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n",
      "m.toml");
  ASSERT_TRUE(parsed) << parsed.error().message;
  const auto circle = [&](double A_deg, std::size_t first, std::size_t second) {
    CircleRequest request;
    request.first = first;
    request.second = second;
    request.radius_m = kCircle_m;
    request.centre[3] = A_deg * std::numbers::pi / 180;
    return predicted_circle(*parsed, request);
  };
  const auto refused = circle(30, 1, 2);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("plane YZ give an ellipse"), std::string::npos);
  EXPECT_FALSE(circle(-1e-4, 1, 2));
  EXPECT_TRUE(circle(0, 1, 2));
  EXPECT_TRUE(circle(90, 0, 1));  // X is perpendicular to Y for each A
  EXPECT_TRUE(circle(180, 1, 2));
  EXPECT_TRUE(circle(30, 0, 2));
}

TEST(CircularTest, SquarenessGivesAnEllipseAt45Degrees) {
  // EC0Y = a: the tool is at x - a y, so the radius is R - a R sin cos. It changes by ± a R / 2 and
  // is smallest at 45°.
  const Machine m = flat_machine("", "EC0Y_urad = 100");
  const CircularFigures f = figures(m);
  EXPECT_NEAR(f.G_ccw_m, 100e-6 * kCircle_m, 1e-9);
  EXPECT_NEAR(f.G_cw_m, f.G_ccw_m, 1e-12);
  EXPECT_NEAR(f.Gb_m, f.G_ccw_m, 1e-12);
  EXPECT_NEAR(f.F_ccw_m[0], +50e-6 * kCircle_m, 1e-9);
  EXPECT_NEAR(f.F_ccw_m[1], -50e-6 * kCircle_m, 1e-9);
  EXPECT_NEAR(f.H_m, 0, 1e-12);
  const auto path = predicted(m, 8).path;
  EXPECT_NEAR(path.ccw_m[1], -50e-6 * kCircle_m, 1e-9);  // angle 45°
  EXPECT_NEAR(path.ccw_m[3], +50e-6 * kCircle_m, 1e-9);
}

TEST(CircularTest, ScaleErrorGivesAnEllipseAlongItsAxis) {
  // EXX = s x: the radius is r = R + s R cos². Its mean is larger by s R / 2, its range is s R.
  const CircularFigures f = figures(flat_machine("EXX_um = [[0, 0], [100, 30]]", ""));
  EXPECT_NEAR(f.G_ccw_m, 300e-6 * kCircle_m, 2e-9);
  EXPECT_NEAR(f.D_m, 150e-6 * kCircle_m, 1e-9);
  EXPECT_NEAR(f.F_ccw_m[0], 300e-6 * kCircle_m, 2e-9);
  EXPECT_NEAR(f.F_ccw_m[1], 0, 2e-9);
}

TEST(CircularTest, BacklashGivesStepsAndHysteresis) {
  // X is 4 µm further when it decreases. In counter-clockwise motion X decreases from 0° to 180°.
  // There r is larger by 4 µm cos; in the other half r is unchanged. In clockwise motion the two
  // halves are exchanged.
  const auto path = predicted(flat_machine("EXX_um = [[0, 0, 4], [100, 0, 4]]", "")).path;
  // The centre of the circle has the mean error of both directions: +2 µm along X.
  EXPECT_NEAR(path.ccw_m[30], +2e-6 * std::cos(30 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(path.cw_m[30], -2e-6 * std::cos(30 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(path.ccw_m[210], -2e-6 * std::cos(210 * std::numbers::pi / 180), 1e-9);
  // X reverses here and still has the error of an increasing X.
  EXPECT_NEAR(path.ccw_m[0], -2e-6, 1e-9);
  EXPECT_NEAR(path.cw_m[0], -2e-6, 1e-9);
  const auto f = circular_figures(path);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->H_m, 4e-6, 1e-9);
  EXPECT_NEAR(f->D_m, 0, 0.05e-6);
  EXPECT_GT(f->Gb_m, 3.9e-6);
}

TEST(CircularTest, WorkAxisGivesTheSameRadialDeviation) {
  const CircularFigures tool = figures(flat_machine("EYX_um = [[0, 0], [100, 9]]", "")),
                        work =
                            figures(flat_machine("EYX_um = [[0, 0], [100, 9]]", "", "w-X-b-Y-t"));
  EXPECT_NEAR(tool.G_ccw_m, 90e-6 * kCircle_m, 1e-9);
  EXPECT_NEAR(work.G_ccw_m, tool.G_ccw_m, 1e-9);
}

TEST(CircularTest, MatchesManualCalculationOfAPath) {
  // A path at 16 angles with an offset of the centre and a radius of +3 µm; the clockwise radius is
  // 1 µm less.
  CircularPath path;
  for (int i = 0; i < 16; ++i) {
    const double a = 2 * std::numbers::pi * i / 16;
    path.angle_rad.push_back(a);
    path.ccw_m.push_back(3e-6 + 5e-6 * std::cos(a) - 2e-6 * std::sin(a));
    path.cw_m.push_back(path.ccw_m.back() - 1e-6);
  }
  auto f = circular_figures(path);
  ASSERT_TRUE(f) << f.error().message;
  EXPECT_NEAR(f->centre_m[0], 5e-6, 1e-15);
  EXPECT_NEAR(f->centre_m[1], -2e-6, 1e-15);
  EXPECT_NEAR(f->D_m, 2.5e-6, 1e-15);
  EXPECT_NEAR(f->Gb_m, 1e-6, 1e-15);
  EXPECT_NEAR(f->G_ccw_m, 0, 1e-15);
  EXPECT_NEAR(f->H_m, 1e-6, 1e-15);
  EXPECT_NEAR(f->F_ccw_m[0], 3e-6, 1e-15);
  EXPECT_NEAR(f->F_cw_m[1], 2e-6, 1e-15);
  EXPECT_NEAR(centred(path, *f).ccw_m[4], 3e-6, 1e-15);
  path.cw_m.clear();
  f = circular_figures(path);
  ASSERT_TRUE(f);
  EXPECT_TRUE(std::isnan(f->Gb_m) && std::isnan(f->H_m) && std::isnan(f->D_m) &&
              std::isnan(f->G_cw_m) && std::isnan(f->F_cw_m[0]));
  EXPECT_NEAR(f->F_ccw_m[1], 3e-6, 1e-15);
}

TEST(CircularTest, RefusesPathsThatAreNoCircle) {
  CircularPath path = predicted(flat_machine("", ""), 8).path;
  EXPECT_TRUE(circular_figures(path));
  path.cw_m.pop_back();
  EXPECT_FALSE(circular_figures(path));
  path = predicted(flat_machine("", ""), 8).path;
  path.ccw_m[3] = std::nan("");
  EXPECT_FALSE(circular_figures(path));
  EXPECT_FALSE(circular_figures({}));
  CircularPath arc;
  for (int i = 0; i < 100; ++i) arc.angle_rad.push_back(0.04 * i), arc.ccw_m.push_back(0);
  EXPECT_FALSE(circular_figures(arc));  // the angles cover 3.96 rad of 6.28 rad
  CircleRequest request;
  request.radius_m = 0.01;
  request.second = 2;
  EXPECT_FALSE(predicted_circle(flat_machine("", ""), request));  // the machine has no Z
  request.second = 1;
  EXPECT_TRUE(predicted_circle(flat_machine("", ""), request));
  for (const double radius : {0.0, -1.0, std::nan(""), 11.0}) {
    request.radius_m = radius;
    EXPECT_FALSE(predicted_circle(flat_machine("", ""), request)) << radius;
  }
  request.radius_m = 0.01;
  request.angles = 7;
  EXPECT_FALSE(predicted_circle(flat_machine("", ""), request));
}

// Harmonics at equal angles. The orders 0 and 1 are removed as the radius and the centre; the
// higher harmonics of each direction remain.
TEST(CircularTest, MatchesManualCalculationOfHarmonics) {
  CircularPath path;
  for (int i = 0; i < 72; ++i) {
    const double a = 2 * std::numbers::pi * i / 72;
    path.angle_rad.push_back(a);
    path.ccw_m.push_back(5 + 3 * std::cos(a) + 1 * std::cos(2 * a));
    path.cw_m.push_back(1 - 1 * std::cos(a) + 4 * std::sin(a) + 2 * std::cos(2 * a));
  }
  const auto f = circular_figures(path);
  ASSERT_TRUE(f) << f.error().message;
  EXPECT_NEAR(f->G_ccw_m, 2, 1e-12);
  EXPECT_NEAR(f->G_cw_m, 4, 1e-12);
  EXPECT_NEAR(f->D_m, 3, 1e-12);
  EXPECT_NEAR(f->centre_m[0], 1, 1e-12);
  EXPECT_NEAR(f->centre_m[1], 2, 1e-12);
  double hysteresis = 0, low = 1e9, high = -1e9, low_ccw = 1e9, high_cw = -1e9;
  for (std::size_t i = 0; i < 72; ++i) {
    const double a = path.angle_rad[i], centre = std::cos(a) + 2 * std::sin(a);
    hysteresis = std::max(hysteresis, std::abs(path.ccw_m[i] - path.cw_m[i]));
    low = std::min({low, path.ccw_m[i] - centre, path.cw_m[i] - centre});
    high = std::max({high, path.ccw_m[i] - centre, path.cw_m[i] - centre});
    low_ccw = std::min(low_ccw, path.ccw_m[i] - centre);
    high_cw = std::max(high_cw, path.cw_m[i] - centre);
  }
  EXPECT_NEAR(f->H_m, hysteresis, 1e-12);
  EXPECT_NEAR(f->Gb_m, high - low, 1e-12);
  EXPECT_NEAR(f->F_ccw_m[1], low_ccw, 1e-12);
  EXPECT_NEAR(f->F_cw_m[0], high_cw, 1e-12);
  path.ccw_m.clear();
  const auto one_way = circular_figures(path);
  EXPECT_NEAR(one_way->G_cw_m, 4, 1e-12);
  EXPECT_NEAR(one_way->centre_m[0], -1, 1e-12);
  EXPECT_TRUE(std::isnan(one_way->G_ccw_m));
  EXPECT_TRUE(std::isnan(one_way->Gb_m));
  EXPECT_TRUE(std::isnan(one_way->H_m));
  EXPECT_TRUE(std::isnan(one_way->D_m));
  EXPECT_TRUE(std::isnan(one_way->F_ccw_m[0]));
}

// One of 16 deviations is 1, at any angle. The least-squares circle has the radius 1/16 and its
// centre is 2/16 towards this angle: 13/16 remains there, and -1/16 - cos(22.5°)/8 at its
// neighbours.
TEST(CircularTest, CountsEachAngle) {
  const double low = -1.0 / 16 - std::cos(std::numbers::pi / 8) / 8;
  for (std::size_t spike = 0; spike < 16; ++spike)
    for (const bool is_ccw : {true, false}) {
      CircularPath path;
      for (int i = 0; i < 16; ++i) path.angle_rad.push_back(2 * std::numbers::pi * i / 16);
      path.ccw_m.assign(16, 0);
      path.cw_m.assign(16, 0);
      (is_ccw ? path.ccw_m : path.cw_m)[spike] = 1;
      const auto both = circular_figures(path);
      ASSERT_TRUE(both);
      EXPECT_NEAR(both->H_m, 1, 1e-12);
      EXPECT_NEAR(is_ccw ? both->G_ccw_m : both->G_cw_m, 13.0 / 16 - low, 1e-12);
      EXPECT_NEAR(is_ccw ? both->G_cw_m : both->G_ccw_m, 0, 1e-12);
      EXPECT_NEAR(both->D_m, 1.0 / 32, 1e-12);
      EXPECT_NEAR(both->centre_m[0], std::cos(path.angle_rad[spike]) / 16, 1e-12);
      EXPECT_NEAR(both->centre_m[1], std::sin(path.angle_rad[spike]) / 16, 1e-12);
      // About the common centre, 1/16 towards the spike, and without the radius.
      const auto& F = is_ccw ? both->F_ccw_m : both->F_cw_m;
      EXPECT_NEAR(F[0], 15.0 / 16, 1e-12);
      EXPECT_NEAR(F[1], -std::cos(std::numbers::pi / 8) / 16, 1e-12);
      // The other direction has 1/16 opposite to the spike, and -1/16 at it.
      EXPECT_NEAR(both->Gb_m, 15.0 / 16 + 1.0 / 16, 1e-12);
      EXPECT_NEAR((is_ccw ? both->F_cw_m : both->F_ccw_m)[0], 1.0 / 16, 1e-12);
      EXPECT_NEAR((is_ccw ? both->F_cw_m : both->F_ccw_m)[1], -1.0 / 16, 1e-12);
      const CircularPath about = centred(path, *both);
      EXPECT_NEAR((is_ccw ? about.ccw_m : about.cw_m)[spike], 15.0 / 16, 1e-12);
      EXPECT_NEAR((is_ccw ? about.cw_m : about.ccw_m)[spike], -1.0 / 16, 1e-12);
    }
}

}  // namespace
}  // namespace mdof::algo
