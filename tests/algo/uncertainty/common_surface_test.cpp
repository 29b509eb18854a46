// The top of one square is measured with the rig of X and the rig of Y. The error of EC0Y is
// calculated for drawn surfaces by the simplified model (contributors_test.cpp) and compared with
// its budget.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/uncertainty/budget/two_runs.h"
#include "algo/uncertainty/effects/plane_footprints.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/drawn_surface.h"
#include "tests/algo/uncertainty/faulty_fixture.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

constexpr double kU_m = 0.05e-6, kAcross_m = 0.010, kAbove_m = 0.020;

std::string planes(double length_mm, const std::string& side_normal, const std::string& top) {
  return "[[plane]]\nid = \"" + top +
         "\"\nnormal = \"+Z\"\nu_flatness_um = 0.05\nflatness_length_mm = " +
         std::to_string(length_mm) + "\n[[plane]]\nid = \"side\"\nnormal = \"" + side_normal +
         "\"\n";
}

Rig rig_along_y(const std::string& end) {
  std::string toml = "name = \"y\"\naxis = \"Y\"\n";
  const auto probe = [](const char* id, const char* place, const char* measures) {
    return std::string("[[probe]]\nid = \"") + id + "\"\nposition_mm = " + place +
           "\nmeasures = \"" + measures + "\"\nrange_um = 200\n";
  };
  toml += probe("A", "[0, 10, 0]", "+Z") + probe("B", "[-10, 0, 0]", "+Z") +
          probe("C", "[10, 0, 0]", "+Z") + probe("D", "[-15, 0, 20]", "-X") +
          probe("E", "[-15, 10, 20]", "-X");
  return parse_rig(toml + end, "y.toml").value();
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return xy / xx;
}

// EC0Y = -slope(EYX) - slope(EXY). The roll (B - C)/2l moves a point at a height of l'' = 20 mm.
// For X, EYX is l'' times the roll. For Y, the local y axis is -X, so EXY is -l'' times the roll.
double squareness_error(const test_faults::DrawnSurface& top, const std::vector<double>& travel) {
  std::vector<double> eyx, exy;
  const auto height = [&](double x, double y) { return top.height_m(x, y); };
  for (const double d : travel) {
    const double b = height(-d, kAcross_m) - height(0, kAcross_m),
                 c = height(-d, -kAcross_m) - height(0, -kAcross_m);
    eyx.push_back(kAbove_m * (b - c) / (2 * kAcross_m));
    const double b_y = height(-kAcross_m, -d) - height(-kAcross_m, 0);
    const double c_y = height(kAcross_m, -d) - height(kAcross_m, 0);
    exy.push_back(-kAbove_m * (b_y - c_y) / (2 * kAcross_m));
  }
  return -slope(travel, eyx) - slope(travel, exy);
}

double stated_u(double length_mm, const std::string& y_top_name) {
  const Rig along_x = test::rig_x_with("", "", planes(length_mm, "+Y", "top"));
  const Rig along_y = rig_along_y(planes(length_mm, "-X", y_top_name));
  const auto budget =
      squareness_budget(along_x, SyntheticRun{.rig = along_x}.measure(), along_y,
                        SyntheticRun{.rig = along_y}.measure(), SquareArtefact{1, 0, 0});
  EXPECT_TRUE(budget) << budget.error().message;
  return budget ? budget->u : 0;
}

TEST(CommonSurface, TopIsCommonToXAndY) {
  const std::vector<double> travel = SyntheticRun{}.targets_m;
  for (const double length_mm : {4.0, 30.0, 400.0}) {
    auto engine = test_faults::well_mixed(31);
    double square = 0;
    const int surfaces = test::coverage_runs(1500);
    for (int i = 0; i < surfaces; ++i)
      square += std::pow(squareness_error({kU_m, length_mm * 1e-3, engine}, travel), 2);
    const double spread = std::sqrt(square / surfaces), u = stated_u(length_mm, "top");
    std::printf("L %.0f mm: u / spread %.3f, as two surfaces %.3f\n", length_mm, u / spread,
                stated_u(length_mm, "another") / spread);
    EXPECT_NEAR(u / spread, 1, 0.06) << length_mm;
  }
  // A twist of the surface changes both slopes with the same sign. If the surface were a pure
  // twist, the ratio of u for one common surface to u for two surfaces would be √2.
  EXPECT_GT(stated_u(400, "top") / stated_u(400, "another"), 1.25);
}

// Three visits of two targets; the fixture is fixed and the target moves. The measured place on the
// target is the place of the probe minus the travel.
TEST(PlaneFootprintsByHand, AreBehindTheProbesByTheMeanTravel) {
  const Rig rig = test::rig_x_with("", "",
                                   "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = "
                                   "0.05\nflatness_length_mm = 12\n"
                                   "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n");
  const Fixture fixture = make_fixture(rig).value();
  mdof::Run run;
  run.points.resize(4);
  std::vector<PointSensitivity> points(4);
  const int target[] = {7, 3, 7, 3};
  const double travel_m[] = {10e-3, 30e-3, 10.2e-3, 99};
  for (std::size_t j = 0; j < 4; ++j) {
    run.points[j].target = target[j];
    points[j].valid = j < 3;
    points[j].travel_m = travel_m[j];
    points[j].by_probe.assign(5, Errors5{});
    for (std::size_t k = 0; k < 5; ++k)
      points[j].by_probe[k] = {static_cast<double>(k + 1), 0, static_cast<double>(j), 0, 0};
  }
  const PlaneFootprints top = plane_footprints(rig, fixture, run, points, 0);
  EXPECT_EQ(top.u_m, 0.05e-6);
  EXPECT_EQ(top.length_m, 12e-3);
  EXPECT_EQ(top.points, 4u);
  ASSERT_EQ(top.footprints.size(), 6u);  // places of A, B and C at targets 3 and 7
  ASSERT_EQ(top.readings.size(), 9u);    // readings of A, B and C at three valid points
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& place = fixture.probes[k].p_MP;
    const Footprint &third = top.footprints[2 * k], &seventh = top.footprints[2 * k + 1];
    EXPECT_LT((third.place - (place - Eigen::Vector3d(30e-3, 0, 0))).norm(), 1e-15);
    EXPECT_LT((seventh.place - (place - Eigen::Vector3d(10.1e-3, 0, 0))).norm(), 1e-15);
    EXPECT_EQ((third.zero - place).norm(), 0);
    EXPECT_EQ((seventh.zero - place).norm(), 0);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& [point, footprint, by_height] = top.readings[3 * k + j];
      EXPECT_EQ(point, j);
      EXPECT_EQ(footprint, 2 * k + (target[j] == 7 ? 1 : 0));
      EXPECT_NEAR(by_height[0], static_cast<double>(k + 1),
                  1e-12);  // the probe is parallel to the normal
      EXPECT_NEAR(by_height[2], static_cast<double>(j), 1e-12);
    }
  }
  EXPECT_EQ(plane_footprints(rig, fixture, run, points, 1).footprints.size(), 4u);
}

}  // namespace
}  // namespace mdof::algo
