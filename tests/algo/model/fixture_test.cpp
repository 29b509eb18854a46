// A rig that contradicts itself is refused; the message states which probes and planes contradict.
// For an ambiguous rig the message asks for a key.
#include "algo/model/fixture.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/algo/calibration/tilted_target.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

constexpr const char* kPlanes = R"(
[[plane]]
id = "top"
normal = "+Z"
offset_mm = 0
[[plane]]
id = "side"
normal = "+Y"
offset_mm = 15
)";

std::string refusal(const std::string& toml) {
  const auto rig = parse_rig(toml, "rig.toml");
  if (!rig) return rig.error().message;
  const auto fixture = make_fixture(*rig);
  return fixture ? "" : fixture.error().message;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

testing::AssertionResult says(const std::string& message,
                              std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (message.find(word) == std::string::npos)
      return testing::AssertionFailure() << "no \"" << word << "\" in: " << message;
  return testing::AssertionSuccess();
}

TEST(Fixture, AcceptsTheDefaultWithAndWithoutPlanes) {
  EXPECT_EQ(refusal(test::rig_x_toml()), "");
  EXPECT_EQ(refusal(test::rig_x_toml() + kPlanes), "");
}

// The calibrated directions of the probes differ by 0.2 mrad. This must not turn the target: the
// axis moves along the faces of the target.
TEST(Fixture, CalibratedDirectionDoesNotTurnTheTarget) {
  Rig rig = *parse_rig(test::mounting_rig_toml(""), "rig.toml");
  ASSERT_TRUE(rig.planes.empty());
  for (Probe& probe : rig.probes) {
    const Vec3 nominal = probe.direction;
    for (double& x : probe.direction) x += x == 0 ? 2e-4 : 0;
    probe.nominal_direction = nominal;
  }
  const Fixture fixture = *make_fixture(rig);
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const FixtureProbe& probe = fixture.probes[k];
    EXPECT_EQ(probe.n_C.cwiseAbs().maxCoeff(), 1) << probe.id;
    EXPECT_EQ(probe.n_C.x(), 0);
    EXPECT_EQ((probe.u_M - probe.n_C).cwiseAbs().maxCoeff(), 2e-4);
  }
}

TEST(Fixture, RefusesAProbeOffItsPlane) {
  EXPECT_TRUE(says(refusal(test::rig_x_toml(10, 14) + kPlanes),
                   {"rig.toml", "\"D\"", "14 mm", "\"side\"", "15 mm", "correct"}));
}

TEST(Fixture, RefusesAPlaneAtTwoDistances) {
  // E is at y = 14 mm, D at y = 15 mm. Both measure in the same direction, so they must face the
  // same plane.
  const std::string moved =
      replaced(test::rig_x_toml(), "[10.000000, 15.000000, 20.000000]", "[10, 14, 20]");
  EXPECT_TRUE(says(refusal(moved), {"\"D\" and \"E\"", "15 mm", "14 mm", "[[plane]]"}));
}

TEST(Fixture, AcceptsADeclaredStepOfTheTarget) {
  std::string stepped = replaced(test::rig_x_toml(), "[10.000000, 15.000000, 20.000000]\n",
                                 "[10, 14, 20]\nplane = \"low\"\n");
  stepped =
      replaced(stepped, "[0.000000, 15.000000, 20.000000]\n", "[0, 15, 20]\nplane = \"side\"\n");
  EXPECT_EQ(
      refusal(stepped + kPlanes + "[[plane]]\nid = \"low\"\nnormal = \"+Y\"\noffset_mm = 14\n"),
      "");
}

TEST(Fixture, AsksForThePlaneOfAnAmbiguousDirection) {
  const std::string tilted =
      replaced(test::rig_x_toml() + kPlanes, "measures = \"+Y\"", "direction = [0, 1, 1]");
  EXPECT_TRUE(
      says(refusal(tilted), {"\"D\"", "\"top\"", "\"side\"", "fits two planes", "plane ="}));
  const std::string named =
      replaced(tilted, "direction = [0, 1, 1]", "direction = [0, 1, 1]\nplane = \"side\"");
  EXPECT_EQ(refusal(named), "");
}

TEST(Fixture, NamesTheExistingPlanes) {
  const std::string unknown = replaced(test::rig_x_toml() + kPlanes, "measures = \"+Y\"",
                                       "measures = \"+Y\"\nplane = \"sied\"");
  EXPECT_TRUE(says(refusal(unknown), {"\"D\"", "\"sied\"", "\"top\"", "\"side\""}));
}

// Each probe in turn is 0.1 mm away from the plane of the other probes; the message must name it.
// Distances up to 1 µm are accepted.
TEST(Fixture, NamesTheProbeThatIsOffThePlane) {
  const std::size_t across[] = {2, 2, 2, 1, 1};  // coordinate that the probe measures
  for (std::size_t k = 0; k < 5; ++k)
    for (const double off_m : {-0.1e-3, 0.1e-3, 0.9e-6, 1.1e-6}) {
      Rig rig = test::rig_x();
      rig.probes[k].position_m[across[k]] += off_m;
      const auto fixture = make_fixture(rig);
      EXPECT_EQ(fixture.has_value(), off_m == 0.9e-6) << k << " " << off_m;
      if (fixture) continue;
      EXPECT_TRUE(says(fixture.error().message,
                       {"measure one plane", ("\"" + rig.probes[k].id + "\"").c_str()}));
    }
}

// The height is linear in both directions between nodes and constant outside. A map with one row or
// one column is constant across it.
TEST(HeightAt, IsBilinearAndConstantOutside) {
  const HeightMap map{{0, 2}, {10, 11, 13}, {1, 2, 6, 3, 5, 1}};
  EXPECT_NEAR(height_at(map, 0, 10), 1, 1e-15);
  EXPECT_NEAR(height_at(map, 2, 13), 1, 1e-15);
  EXPECT_NEAR(height_at(map, 0.5, 10.25), 0.75 * 1.25 + 0.25 * 3.5, 1e-15);
  EXPECT_NEAR(height_at(map, 1.5, 12), 0.25 * 4 + 0.75 * 3, 1e-15);
  EXPECT_NEAR(height_at(map, -5, 11), 2, 1e-15);
  EXPECT_NEAR(height_at(map, 9, 99), 1, 1e-15);
  const HeightMap row{{7}, {0, 1, 2}, {4, 6, 5}}, column{{0, 1, 2}, {7}, {4, 6, 5}};
  for (const double across : {-3.0, 7.0, 30.0})
    for (const auto& [at, height] :
         {std::pair(-1.0, 4.0), std::pair(0.5, 5.0), std::pair(1.25, 5.75), std::pair(8.0, 5.0)}) {
      EXPECT_NEAR(height_at(row, across, at), height, 1e-15) << at;
      EXPECT_NEAR(height_at(column, at, across), height, 1e-15) << at;
    }
  EXPECT_EQ(height_at({}, 1, 1), 0);
}

// The normals of two planes have cosines of 0.8 and 0.7 to the direction of probe A, which is too
// similar. The third plane is parallel to the probe.
TEST(Fixture, FindsTheTwoNearestPlanesInAnyOrder) {
  TargetPlane nearest, second, other;
  nearest.id = "near";
  nearest.normal = {0, 0.6, 0.8};
  second.id = "second";
  second.normal = {0, -0.714, 0.7};
  other.id = "other";
  other.normal = {1, 0, 0};
  for (const std::vector<TargetPlane>& planes : {std::vector{nearest, other, second},
                                                 {nearest, second, other},
                                                 {other, nearest, second},
                                                 {second, nearest, other},
                                                 {other, second, nearest},
                                                 {second, other, nearest}}) {
    Rig rig = test::rig_x();
    rig.planes = planes;
    const auto fixture = make_fixture(rig);
    ASSERT_FALSE(fixture);
    EXPECT_TRUE(
        says(fixture.error().message, {"\"A\"", "fits two planes, \"near\" and \"second\""}))
        << planes[0].id << planes[1].id;
  }
}

}  // namespace
}  // namespace mdof::algo
