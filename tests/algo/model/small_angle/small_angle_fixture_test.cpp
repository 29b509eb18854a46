// Tests which fixtures the simplified and the exact model accept. Mutation tests (tests/mutate)
// found these cases.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algo/model/rigid.h"
#include "algo/model/small_angle/small_angle.h"
#include "algo/model/solver.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

Fixture five_probe_fixture() {
  return make_fixture(test::rig_x()).value();
}

// Reason why the fixture is refused; empty if it is accepted.
std::string refused(const Fixture& fixture) {
  const auto made = make_small_angle_fixture(fixture);
  return made ? "" : made.error().message;
}

testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in: " << message;
}

TEST(SmallAngleFixture, HasThreeTopProbesAndTwoSideProbes) {
  EXPECT_EQ(refused(five_probe_fixture()), "");
  for (const std::size_t more : {0u, 3u}) {
    Fixture fixture = five_probe_fixture();
    fixture.probes.push_back(fixture.probes[more]);
    EXPECT_TRUE(says(refused(fixture), more == 0 ? "has 4 probes along ±z and 2 along ±y"
                                                 : "has 3 probes along ±z and 3 along ±y"));
  }
  Fixture fixture = five_probe_fixture();
  fixture.probes.pop_back();
  EXPECT_TRUE(says(refused(fixture), "has 3 probes along ±z and 1 along ±y"));
  fixture = five_probe_fixture();
  fixture.probes.erase(fixture.probes.begin());
  EXPECT_TRUE(says(refused(fixture), "has 2 probes along ±z and 2 along ±y"));
}

// D and E are 1 mm apart along the motion. If they are also 20 mm apart along z, the exact model
// has an error of 76 µm at 30 mrad.
TEST(SmallAngleFixture, RefusesSideProbesTooCloseAlongTheMotion) {
  Fixture fixture = five_probe_fixture();
  fixture.probes[4].p_MP.x() = fixture.probes[3].p_MP.x() + 1e-3;
  fixture.probes[4].p_MP.z() = fixture.probes[3].p_MP.z() + 3e-3;
  EXPECT_EQ(refused(fixture), "");
  fixture.probes[4].p_MP.z() = fixture.probes[3].p_MP.z() - 3.1e-3;
  EXPECT_TRUE(says(refused(fixture), "too close together along the motion"));
}

TEST(SmallAngleFixture, MeasuresAlongTheAxes) {
  for (const std::size_t k : {0u, 3u}) {
    Fixture fixture = five_probe_fixture();
    const Eigen::Vector3d tilted = fixture.probes[k].u_M + Eigen::Vector3d(1e-4, 0, 0);
    fixture.probes[k].n_C = fixture.probes[k].u_M = tilted / std::sqrt(tilted.dot(tilted));
    EXPECT_TRUE(says(refused(fixture), "measures along neither")) << k;
    fixture = five_probe_fixture();
    fixture.probes[k].n_C = Eigen::Vector3d(0, 0.6, 0.8);
    EXPECT_TRUE(says(refused(fixture), "is not perpendicular to its plane")) << k;
    fixture = five_probe_fixture();
    fixture.probes[k].n_C = fixture.probes[k].u_M = Eigen::Vector3d::UnitX();
    EXPECT_TRUE(says(refused(fixture), "measures along neither")) << k;
    fixture = five_probe_fixture();
    fixture.probes[k].flatness = {{0, 1}, {0, 1}, {0, 0, 0, 0}};
    EXPECT_TRUE(says(refused(fixture), "a flatness map")) << k;
  }
}

// The distance of a probe from its plane may be at most 1 nm.
TEST(SmallAngleFixture, UsesOneTopPlaneAndOneSidePlane) {
  for (const double off_m : {0.9e-9, 1.1e-9, -1.1e-9}) {
    const bool taken = off_m < 1e-9 && off_m > 0;
    for (const std::size_t k : {0u, 1u, 2u}) {
      Fixture fixture = five_probe_fixture();
      fixture.probes[k].p_MP.z() += off_m;
      EXPECT_EQ(refused(fixture).empty(), taken) << k << " " << off_m;
    }
    for (const std::size_t k : {3u, 4u}) {
      Fixture fixture = five_probe_fixture();
      fixture.probes[k].p_MP.y() += off_m;
      EXPECT_EQ(refused(fixture).empty(), taken) << k << " " << off_m;
    }
  }
}

// The area of the triangle of the top probes must be at least half of 1e-9 m2. The distance of the
// side probes must be at least 10 um, in either order.
TEST(SmallAngleFixture, IsWideEnough) {
  for (const double height_m : {0.9e-6, 1.1e-6}) {
    Fixture flat = five_probe_fixture();
    flat.probes[0].p_MP = {0, 0, 0};
    flat.probes[1].p_MP = {1e-3, 0, 0};
    flat.probes[2].p_MP = {0, height_m, 0};
    EXPECT_EQ(refused(flat).empty(), height_m > 1e-6) << height_m;
  }
  for (const double apart_m : {0.9e-5, 1.1e-5, -0.9e-5, -1.1e-5}) {
    Fixture narrow = five_probe_fixture();
    narrow.probes[4].p_MP.x() = narrow.probes[3].p_MP.x() + apart_m;
    EXPECT_EQ(refused(narrow).empty(), std::abs(apart_m) > 1e-5) << apart_m;
  }
}

// Each probe in turn measures in the opposite direction. The readings come from the rigid model;
// for such small errors the other models differ by about 10 nrad and 10 nm.
TEST(SmallAngleFixture, EachProbeHasItsOwnSign) {
  const Errors5 e{3e-6, -2e-6, 1e-4, 2e-4, -3e-4};
  for (std::size_t turned = 0; turned < 5; ++turned) {
    Rig rig = test::rig_x();
    for (double& component : rig.probes[turned].direction) component = -component;
    const Eigen::VectorXd model = rigid_readings(make_fixture(rig).value(), 0.03, e);
    const std::vector<double> readings(model.begin(), model.end());
    for (const Model kind : {Model::simplified, Model::exact}) {
      const AxisErrors got = Solver::create(rig, kind).value().solve(0.03, readings, {});
      ASSERT_TRUE(got.valid);
      for (std::size_t k = 0; k < 5; ++k)
        EXPECT_NEAR(got.local[k], e[k], 1e-7) << turned << " " << k;
    }
  }
}

// Two iterations with the initial slope are accurate to 1e-11 rad up to 50 mrad, also if D and E
// are at different heights.
TEST(SmallAngleFixture, IsSolvedToRoundingUpToFiftyMilliradians) {
  for (const double height_m : {20e-3, 32e-3, 6e-3}) {
    Rig rig = test::rig_x();
    rig.probes[4].position_m[2] = height_m;
    const SmallAngleFixture fixture = make_small_angle_fixture(make_fixture(rig).value()).value();
    for (const double x : {-0.05, 0.02, 0.05})
      for (const double y : {-0.05, 0.03, 0.05})
        for (const double z : {-0.05, -0.01, 0.05}) {
          const Errors5 e{3e-5, -2e-5, x, y, z};
          const auto found =
              solve_small_angle(Model::exact, fixture, 0.03, exact_outputs(fixture, 0.03, e));
          for (std::size_t k = 0; k < 5; ++k)
            EXPECT_NEAR(found[k], e[k], k < 2 ? 1e-13 : 1e-11)
                << height_m << " " << x << " " << y << " " << z << " " << k;
        }
  }
}

}  // namespace
}  // namespace mdof::algo
