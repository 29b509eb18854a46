// Height maps that do not cover the travel of the probes. The notices state plane, direction and
// probe.
#include "algo/plausibility/map_cover.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

// Two probes over a top plane, at x = 0 and x = 10 mm; their distance along y is 20 mm.
struct Mapped {
  Rig rig;
  Fixture fixture;

  Mapped(std::vector<double> first_m, std::vector<double> second_m) {
    rig.planes.resize(2);
    rig.planes[1].id = "top";
    rig.planes[1].flatness = {first_m, second_m,
                              std::vector<double>(first_m.size() * second_m.size(), 1e-6)};
    for (const double x_m : {0.0, 10e-3}) {
      FixtureProbe probe;
      probe.id = x_m > 0 ? "B" : "A";
      probe.p_MP = {x_m, x_m > 0 ? 10e-3 : -10e-3, 0};
      probe.u_M = probe.n_C = {0, 0, 1};
      probe.plane = 1;
      fixture.probes.push_back(probe);
    }
  }
  Notices said(double least_m, double most_m) const {
    return map_notices(rig, fixture, least_m, most_m);
  }
};

TEST(MapCover, HasNoNoticeIfTheMapCoversTheTravel) {
  EXPECT_TRUE(Mapped({-60e-3, 10e-3}, {-10e-3, 10e-3}).said(0, 60e-3).empty());
  EXPECT_TRUE(Mapped({-60e-3, 10e-3}, {-10e-3, 10e-3}).said(-49e-6, 60.049e-3).empty());
  EXPECT_TRUE(Mapped({0}, {0}).said(0, 60e-3).empty());  // the map is constant in both directions
  EXPECT_TRUE(Mapped({-60e-3, 10e-3}, {0}).said(0, 60e-3).empty());
  EXPECT_TRUE(Mapped({}, {}).said(0, 60e-3).empty());
}

TEST(MapCover, ReportsPlaneDirectionAndProbe) {
  const auto said = Mapped({-60e-3, 0}, {-10e-3, 5e-3}).said(0, 60e-3);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(test::shown(said),
            "map_too_short top coordinate=flatness_first_mm covered_from_mm=-60 covered_to_mm=0 "
            "reached=probe B reads at -50 to 10 mm\n"
            "map_too_short top coordinate=flatness_second_mm covered_from_mm=-10 covered_to_mm=5 "
            "reached=probe B reads at 10 mm\n");
}

TEST(MapCover, ChecksBothEndsAndOnlyProbesOfThePlane) {
  Mapped mapped({-60e-3, 10e-3}, {0});
  EXPECT_EQ(mapped.said(-51e-6, 60e-3).size(), 1u);
  EXPECT_EQ(mapped.said(0, 60.051e-3).size(), 1u);
  const Notice too_far = mapped.said(0, 70e-3)[0];
  const NoticeValue* reached = value(too_far, "reached");
  ASSERT_TRUE(reached);
  EXPECT_EQ(std::get<std::string>(*reached), "probe A reads at -70 to 0 mm");
  for (FixtureProbe& probe : mapped.fixture.probes) probe.plane = 0;
  EXPECT_TRUE(mapped.said(-1, 1).empty());
}

// The map axes are x and z for a side plane, and y and z for a plane across the motion.
TEST(MapCover, UsesTheAxesOfThePlane) {
  Mapped mapped({-60e-3, 10e-3}, {15e-3, 25e-3});
  for (FixtureProbe& probe : mapped.fixture.probes) {
    probe.n_C = {0, 1, 0};
    probe.p_MP.z() = 20e-3;
  }
  EXPECT_TRUE(mapped.said(0, 60e-3).empty());
  mapped.fixture.probes[0].p_MP.z() = 26e-3;
  EXPECT_EQ(mapped.said(0, 60e-3).size(), 1u);
}

TEST(MapCover, UsesTheTargetTravelOfPointsWithValidErrors) {
  const Mapped mapped({-60e-3, 10e-3}, {0});
  std::vector<MeasuredPoint> points(3);
  for (std::size_t i = 0; i < 3; ++i) {
    points[i].point.position_m = 60e-3 * static_cast<double>(i);
    points[i].errors.valid = i < 2;
  }
  EXPECT_TRUE(map_notices(mapped.rig, mapped.fixture, points).empty());
  Rig turned = mapped.rig;
  turned.sides.against_encoder = true;
  EXPECT_EQ(map_notices(turned, mapped.fixture, points).size(), 1u);
  points[2].errors.valid = true;
  EXPECT_EQ(map_notices(mapped.rig, mapped.fixture, points).size(), 1u);
  EXPECT_TRUE(map_notices(mapped.rig, mapped.fixture, std::vector<MeasuredPoint>(2)).empty());
}

// A plane across the motion has the map axes y and z, so the travel has no effect.
TEST(MapCover, PlaneAcrossTheMotionHasTheMapAxesYAndZ) {
  Mapped mapped({-11e-3, 11e-3}, {4e-3, 6e-3});
  for (FixtureProbe& probe : mapped.fixture.probes) {
    probe.n_C = {-1, 0, 0};
    probe.p_MP.z() = 5e-3;
  }
  EXPECT_TRUE(mapped.said(0, 60e-3).empty());
  mapped.fixture.probes[0].p_MP.z() = 7e-3;
  const auto high = mapped.said(0, 60e-3);
  ASSERT_EQ(high.size(), 1U);
  EXPECT_NE(test::shown(high).find("flatness_second_mm"), std::string::npos);
  mapped.fixture.probes[0].p_MP = {0, 12e-3, 5e-3};
  EXPECT_NE(test::shown(mapped.said(0, 60e-3)).find("flatness_first_mm"), std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
