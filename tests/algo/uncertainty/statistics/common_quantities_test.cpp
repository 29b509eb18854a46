// Tests which contributors of two set-ups are the same quantity, and how one surface affects runs
// along different axes.
#include "algo/uncertainty/statistics/common_quantities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "algo/uncertainty/effects/flatness.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

Contributor declared_as(const ContributorName& name, const std::string& key, double u) {
  Contributor contributor;
  contributor.name = name;
  contributor.key = key;
  contributor.declared.u = u;
  contributor.to_unit = 1e6;
  contributor.parts = [] { return std::vector<PointShifts>{{Errors5{7, 0, 0, 0, 0}}}; };
  return contributor;
}

std::string common_name(const Rig& rig, const Contributor& contributor) {
  std::vector<Contributor> list = {contributor};
  name_probe_correlations(rig, list);
  return list[0].common_as;
}

// The scale, linearity and tilt factor of a probe are common to all set-ups with the same
// certificate of the probe. The zero of a probe is not.
TEST(CommonQuantities, ProbeQuantitiesDependOnItsCertificate) {
  Rig rig = test::rig_x_with("", ""), other = rig;
  rig.probes[1].calibration.certificate = "K 17";
  other.probes[1].calibration.certificate = "K 18";
  const std::string id = rig.probes[1].id;
  for (const char* key : {"u_sensitivity_ppm", "u_linearity_um", "u_tilt_factor", "tilt_factor",
                          "linearity", "polynomial_um"}) {
    const Contributor one = declared_as({ContributorKind::probe_linearity, id}, key, 3e-6);
    EXPECT_FALSE(common_name(rig, one).empty()) << key;
    EXPECT_EQ(common_name(rig, one), common_name(rig, one));
    EXPECT_NE(common_name(rig, one), common_name(other, one));
    EXPECT_EQ(common_name(rig, one),
              common_name(rig, declared_as({ContributorKind::probe_linearity, id}, key, 4e-6)));
  }
  EXPECT_EQ(common_name(rig, declared_as({ContributorKind::probe_calibration, id},
                                         "u_calibration_um", 1e-6)),
            "");
  EXPECT_EQ(
      common_name(rig, declared_as({ContributorKind::probe_linearity, "Q"}, "linearity", 1e-6)),
      "");
}

TEST(CommonQuantities, PlanesAreOneIfNameNormalUAndLengthAreEqual) {
  const auto named = [](const std::string& plane, const Vec3& normal, double u, double length_m) {
    Rig rig = test::rig_x_with(
        "", "", "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n[[plane]]\nnormal = \"+Y\"\n");
    rig.planes[0].normal = rig.planes[1].normal = normal;
    std::vector<Contributor> list = {
        declared_as({ContributorKind::plane_flatness, plane}, "u_flatness_um", u)};
    list[0].surface = std::make_shared<const PlaneFootprints>(PlaneFootprints{u, length_m, {}, {}});
    name_common_surfaces(rig, list);
    return list[0].surface_as;
  };
  const std::string top = named("top", {0, 0, 1}, 1e-7, 0.02);
  EXPECT_FALSE(top.empty());
  EXPECT_EQ(top, named("top", {0, 0, 1}, 1e-7, 0.02));
  EXPECT_NE(top, named("top", {0, 0.1, 0.99}, 1e-7, 0.02));
  EXPECT_NE(top, named("top", {0, 0, 1}, 2e-7, 0.02));
  EXPECT_NE(top, named("top", {0, 0, 1}, 1e-7, 0.03));
  const std::string second = named("2", {0, 0, 1}, 1e-7, 0.02);  // a plane without id
  EXPECT_FALSE(second.empty());
  EXPECT_NE(second, top);
  EXPECT_EQ(named("1", {0, 0, 1}, 1e-7, 0.02), "");
}

const Eigen::Vector3d kZeroed(0.001, -0.003, 0.02);  // position of the probe at d = 0

// `places`: (x, y, z) in M. A run along Y has the local axes x = +Y and y = -X.
Contributor over_surface(const std::vector<Eigen::Vector3d>& places, bool along_y) {
  PlaneFootprints surface{1e-7, 0.05, {}, {}, places.size()};
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto local = [&](const Eigen::Vector3d& p) {
      return along_y ? Eigen::Vector3d(p.y(), -p.x(), p.z()) : p;
    };
    surface.footprints.push_back({local(places[j]), local(kZeroed)});
    surface.readings.push_back({j, j, Errors5{1, 0, -2, 0, 0}});
  }
  Contributor contributor =
      declared_as({ContributorKind::plane_flatness, "top"}, "u_flatness_um", 1e-7);
  contributor.surface = std::make_shared<const PlaneFootprints>(std::move(surface));
  contributor.surface_as = "top";
  return contributor;
}

TEST(CommonQuantities, SurfaceHasTheSameHeightForRunsAlongXAndY) {
  const std::vector<Eigen::Vector3d> places = {
      {0.01, 0, 0.02}, {0.02, 0.004, 0.02}, {-0.03, 0.01, 0.021}, {0.005, -0.04, 0.019}};
  std::vector<Contributor> of_a = {
      declared_as({ContributorKind::probe_calibration, "A"}, "u_calibration_um", 1e-6),
      over_surface(places, false)};
  std::vector<Contributor> of_b = {over_surface(places, true)};
  const TwoRunParts parts = parts_of_both_runs(of_a, Axis::x, of_b, Axis::y);
  ASSERT_EQ(parts.a.size(), 2u);
  ASSERT_EQ(parts.b.size(), 1u);
  ASSERT_EQ(parts.a[1].size(), parts.b[0].size());
  ASSERT_FALSE(parts.b[0].empty());
  double largest = 0;
  for (std::size_t p = 0; p < parts.b[0].size(); ++p)
    for (std::size_t j = 0; j < places.size(); ++j) {
      EXPECT_NEAR(parts.a[1][p][j][0], parts.b[0][p][j][0], 1e-14);
      EXPECT_NEAR(parts.b[0][p][j][2], -2 * parts.b[0][p][j][0], 1e-20);
      largest = std::max(largest, std::abs(parts.b[0][p][j][0]));
    }
  EXPECT_GT(largest, 1e-8);
  // The covariance of the contributions equals the covariance of the heights at these places in M.
  const FlatnessCovariance covariance(1e-7, 0.05);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j) {
      double sum = 0;
      for (const auto& part : parts.b[0]) sum += part[i][0] * part[j][0];
      EXPECT_NEAR(sum, covariance.zeroed_m2({places[i], kZeroed}, {places[j], kZeroed}), 1e-20);
    }
  EXPECT_EQ(of_a[1].common_as, "top");
  EXPECT_EQ(of_b[0].common_as, "top");
  EXPECT_EQ(of_a[0].common_as, "");
  EXPECT_EQ(parts.a[0][0][0][0], 7);  // the part of a quantity that is not common
}

TEST(CommonQuantities, TwoSurfacesHaveSeparateParts) {
  std::vector<Contributor> of_a = {over_surface({{0.01, 0, 0.02}}, false)};
  std::vector<Contributor> of_b = {over_surface({{0.01, 0, 0.02}}, true)};
  of_b[0].surface_as = "another top";
  const TwoRunParts parts = parts_of_both_runs(of_a, Axis::x, of_b, Axis::y);
  EXPECT_EQ(of_a[0].common_as + of_b[0].common_as, "");
  EXPECT_EQ(parts.a[0][0][0][0], 7);
  of_a[0].surface_as = "";
  of_b = {declared_as({ContributorKind::probe_calibration, "A"}, "u_calibration_um", 1e-6)};
  EXPECT_EQ(parts_of_both_runs(of_a, Axis::x, of_b, Axis::y).b[0][0][0][0], 7);
  EXPECT_EQ(parts.b[0][0][0][0], 7);
}

}  // namespace
}  // namespace mdof::algo
