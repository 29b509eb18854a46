// Effects of declared uncertainties on the errors, by the simplified model (Eq. 8-12) with l = 10
// mm and l'' = 20 mm:
// EAX = (B - C)/2l, EBX = ((B + C)/2 - A)/l, ECX = (E - D)/l,
// and at the fixture EZX = (B + C)/2, EYX = D + EAX l''.
#include "algo/uncertainty/contributors.h"

#include <gtest/gtest.h>

#include "schema/units.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kL_m = 0.010, kUp_m = 0.020;

using test::rig_x_with;

std::vector<Contributor> of(const Rig& rig, const Run& run) {
  auto found = contributors(rig, run);
  EXPECT_TRUE(found) << found.error().message;
  return found.value_or(std::vector<Contributor>{});
}

void expect_shift(const Errors5& shift, const Errors5& expected, double tolerance = 1e-12) {
  for (std::size_t e = 0; e < 5; ++e) EXPECT_NEAR(shift[e], expected[e], tolerance) << e;
}

TEST(Contributors, EmptyWithoutDeclarations) {
  const Rig rig = rig_x_with("", "");
  EXPECT_TRUE(of(rig, SyntheticRun{.rig = rig}.measure()).empty());
}

TEST(Contributors, CalibrationErrorIsEqualAtEachPoint) {
  const double u = 0.1e-6;
  const struct {
    const char* probe;
    Errors5 shift;
  } cases[] = {{"A", {0, 0, 0, -u / kL_m, 0}},
               {"B", {u / 2 / kL_m * kUp_m, u / 2, u / 2 / kL_m, u / 2 / kL_m, 0}},
               {"C", {-u / 2 / kL_m * kUp_m, u / 2, -u / 2 / kL_m, u / 2 / kL_m, 0}},
               {"D", {u, 0, 0, 0, -u / kL_m}},
               {"E", {0, 0, 0, 0, u / kL_m}}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.probe);
    const Rig rig = rig_x_with(c.probe, "u_calibration_um = 0.1");
    const auto all = of(rig, SyntheticRun{.rig = rig, .model = Model::simplified}.measure());
    ASSERT_EQ(all.size(), 2u);  // the second is the contributor of the simplified model
    EXPECT_EQ(contributor_text(all[0].name), "probe " + std::string(c.probe) + ": calibration");
    EXPECT_DOUBLE_EQ(all[0].declared.u * all[0].to_unit, 0.1);
    const auto parts = all[0].parts();
    ASSERT_EQ(parts.size(), 1u);
    for (const Errors5& shift : parts[0]) expect_shift(shift, c.shift);
  }
}

// The target rises by 20 µm/mm. The reading of B rises by the same amount, and so does the effect
// of its scale error.
TEST(Contributors, SensitivityErrorIsProportionalToTheReading) {
  const Rig rig = rig_x_with("B", "u_sensitivity_ppm = 1000");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{0, 0.02 * d, 0, 0, 0}; };
  const auto run = synthetic.measure();
  const auto parts = of(rig, run)[0].parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double u = 1e-3 * 0.02 * run.points[j].target_m;
    expect_shift(parts[0][j], {u, u / 2, u / 2 / kL_m, u / 2 / kL_m, 0});
  }
}

// Probe E is 1 mm further along x and reads (l + 1 mm) times the yaw. So the calculated yaw is a
// tenth too large, and δy at D is unchanged.
TEST(Contributors, PositionErrorActsWithTheYaw) {
  const Rig rig = rig_x_with("E", "u_position_mm = [1, 0, 0]");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{0, 0, 0, 0, 0.01 * d}; };
  const auto run = synthetic.measure();
  const auto all = of(rig, run);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(contributor_text(all[0].name), "probe E: position x");
  const auto parts = all[0].parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double yaw = 0.01 * run.points[j].target_m;
    expect_shift(parts[0][j], {0, 0, 0, 0, 0.1 * yaw}, 1e-9);
  }
}

// A drift of 0.36 µm/h is 0.1 nm/s.
TEST(Contributors, DriftGrowsWithTimeFromTheFirstPoint) {
  const Rig rig = rig_x_with("", "", "[drift]\nu_um_per_h = 0.36\n");
  const auto run = SyntheticRun{.rig = rig, .model = Model::simplified}.measure();
  const auto all = of(rig, run);
  ASSERT_EQ(all.size(), 6u);  // the sixth is the contributor of the simplified model
  EXPECT_EQ(contributor_text(all[3].name), "probe D: drift");
  EXPECT_NEAR(all[3].declared.u * all[3].to_unit, 0.36, 1e-12);
  const auto parts = all[3].parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double u = 1e-10 * 10 * static_cast<double>(j);
    expect_shift(parts[0][j], {u, 0, 0, 0, -u / kL_m});
  }
}

// A fixture is rolled by 1 mrad about X, and the target rises with the travel.
TEST(Contributors, InstallationRollHasNoEffectOnALevelPlane) {
  const Rig rig = rig_x_with("", "", "[installation]\nu_angle_mrad = [1, 0, 0]\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{0, 1e-3 * d, 0, 0, 0}; };
  const auto run = synthetic.measure();
  const auto parts = of(rig, run)[0].parts();
  // The plane remains level, so the displacement of the probes by a roll of 1 mrad has no effect.
  for (std::size_t j = 0; j < run.points.size(); ++j)
    for (std::size_t e = 0; e < 5; ++e) EXPECT_NEAR(parts[0][j][e], 0, 2e-10) << j << " " << e;
}

// The effect is 0 where the probe was zeroed; elsewhere its u is √2 u √(1 - correlation).
TEST(Contributors, FlatnessActsByItsChangeSinceZeroing) {
  const Rig rig = rig_x_with("", "",
                             "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n"
                             "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.05\n");
  const auto run = SyntheticRun{.rig = rig, .model = Model::exact}.measure();
  const auto all = of(rig, run);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(contributor_text(all[0].name), "plane side: flatness");
  EXPECT_NE(all[0].surface_as.find("plane side"), std::string::npos);
  const auto parts = all[0].parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    double square = 0, top = 0, correlation = 0, norm = 0;
    for (const auto& part : parts) {
      square += part[j][kDy] * part[j][kDy];
      top += std::abs(part[j][kDz]) + std::abs(part[j][kEx]);
    }
    for (int k = 1; k <= 4; ++k) {
      norm += std::pow(k, -4);
      correlation +=
          std::pow(k, -4) * std::cyl_bessel_j(0, 2 * M_PI * k * run.points[j].target_m / 0.03);
    }
    // At the fixture EYX is the reading of D.
    EXPECT_NEAR(std::sqrt(square), 0.05e-6 * std::sqrt(2 * (1 - correlation / norm)), 1e-12) << j;
    EXPECT_NEAR(top, 0, 1e-12);
  }
  // The surface has the same height for all visits of a target.
  const std::size_t targets = 9;
  for (const auto& part : parts) EXPECT_EQ(part[0], part[2 * targets]);
}

// The carriage's δy is D + roll l'' + d yaw, so an error of 1 µm of the travel d changes δy by 1 µm
// times the yaw.
TEST(Contributors, EncoderErrorActsAtEachTargetSeparately) {
  const Rig rig = rig_x_with("", "", "[encoder]\nu_um = 1\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .stated = kAtCarriage};
  synthetic.truth = [](double) { return Errors5{0, 0, 0, 0, 1e-3}; };
  const auto run = synthetic.measure();
  const auto parts = of(rig, run)[0].parts();
  ASSERT_EQ(parts.size(), 9u);
  for (std::size_t j = 0; j < run.points.size(); ++j)
    for (std::size_t t = 0; t < parts.size(); ++t) {
      const bool here = run.points[j].target == static_cast<int>(t) + 1;
      EXPECT_NEAR(parts[t][j][kDy], here ? 1e-9 : 0, 2e-12);
    }
}

TEST(Contributors, RejectsAnImpossibleDirection) {
  const Rig rig = rig_x_with("D", "u_direction_mrad = 300");
  const auto found = contributors(rig, SyntheticRun{.rig = rig}.measure());
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("u_direction_mrad"), std::string::npos);
}

TEST(Contributors, RejectsRunsWithoutPointsOrWithWrongAngles) {
  const Rig rig = rig_x_with("", "", "[encoder]\nu_um = 1\n[drift]\nu_um_per_h = 1\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  auto run = synthetic.measure();
  EXPECT_TRUE(contributors(rig, run));
  for (double& reading : run.points[3].point.probe_m) reading = 0;
  run.points[3].point.probe_m[4] = 3e-3;  // E is 10 mm from D, so the yaw would be 300 mrad
  const auto turned = contributors(rig, run);
  ASSERT_FALSE(turned);
  EXPECT_NE(turned.error().message.find("at target 4"), std::string::npos);
  run.points.clear();
  const auto empty = contributors(rig, run);
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().message.find("no points"), std::string::npos);
}

// Probe B measures a plane with the pitch p; the reading of B is s. If B is tilted by c along the
// motion, its measured spot moves by c s, and its reading changes by p c s. A tilt across the
// motion has no such effect. Both tilts lengthen the path of the probe to the plane: the reading is
// s / cos c, so it changes by s c²/2. For normally distributed tilts with the standard deviation u
// about two axes, the root mean square of (c1² + c2²)/2 is √2 u².
TEST(Contributors, DirectionHasPartsAlongAndAcrossTheSlope) {
  const Rig rig = rig_x_with("B", "u_direction_mrad = 5");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{0, 1e-3 * d, 0, 0.05 * d, 0}; };
  const auto run = synthetic.measure();
  const auto parts = of(rig, run)[0].parts();
  ASSERT_EQ(parts.size(), 3u);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double d = run.points[j].target_m, s = run.points[j].point.probe_m[1];
    EXPECT_NEAR(std::abs(parts[2][j][kEx]) * 2 * kL_m, std::sqrt(2.0) * 25e-6 * std::abs(s),
                1e-3 * 25e-6 * std::abs(s));
    const double first = std::abs(parts[0][j][kEx]) * 2 * kL_m,
                 second = std::abs(parts[1][j][kEx]) * 2 * kL_m;
    const double expected = 0.05 * d * 5e-3 * s;
    EXPECT_NEAR(std::max(first, second), std::abs(expected), 0.02 * std::abs(expected) + 1e-14)
        << j;
    EXPECT_NEAR(std::min(first, second), 0, 0.02 * std::abs(expected) + 1e-14) << j;
  }
}

// All probes are 1 mm further along x over a plane with the pitch p. There the plane is lower by p
// times 1 mm; the calculated pitch is unchanged.
TEST(Contributors, OffsetAlongTheMotionActsWithThePitch) {
  const Rig rig = rig_x_with("", "", "[installation]\nu_offset_mm = [1, 0, 0]\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{0, 0, 0, 0.02 * d, 0}; };
  const auto run = synthetic.measure();
  const auto parts = of(rig, run)[0].parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double lower = 1e-3 * 0.02 * run.points[j].target_m;
    expect_shift(parts[0][j], {0, -lower, 0, 0, 0}, 0.01 * std::abs(lower) + 1e-12);
  }
}

// All probes are 1 mm further along y or z, and the target has the roll r. There the top is higher
// by r times 1 mm, and the side is further away.
TEST(Contributors, OffsetAcrossTheMotionActsWithTheRoll) {
  for (const std::size_t c : {1u, 2u}) {
    const Rig rig = rig_x_with(
        "", "",
        std::string("[installation]\nu_offset_mm = ") + (c == 1 ? "[0, 1, 0]\n" : "[0, 0, 1]\n"));
    SyntheticRun synthetic{.rig = rig, .model = Model::exact};
    synthetic.truth = [](double d) { return Errors5{0, 0, 0.02 * d, 0, 0}; };
    const auto run = synthetic.measure();
    const auto parts = of(rig, run)[0].parts();
    for (std::size_t j = 0; j < run.points.size(); ++j) {
      const double by = 1e-3 * 0.02 * run.points[j].target_m;
      expect_shift(parts[0][j], c == 1 ? Errors5{0, by, 0, 0, 0} : Errors5{-by, 0, 0, 0, 0},
                   0.01 * by + 1e-12);
    }
  }
}

TEST(Contributors, RejectsAnImpossibleInstallationAngle) {
  for (const char* angles : {"[300, 0, 0]", "[0, 300, 0]", "[0, 0, 300]"}) {
    const Rig rig =
        rig_x_with("", "", std::string("[installation]\nu_angle_mrad = ") + angles + "\n");
    const auto found = contributors(rig, SyntheticRun{.rig = rig}.measure());
    ASSERT_FALSE(found) << angles;
    EXPECT_NE(found.error().message.find("u_angle_mrad"), std::string::npos);
  }
}

// The contributor has at most 256 parts. With more targets, two neighbouring targets share a part.
TEST(Contributors, EncoderContributorHasFewerPartsForManyTargets) {
  const Rig rig = rig_x_with("", "", "[encoder]\nu_um = 1\n");
  for (const int targets : {256, 257}) {
    SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 1};
    synthetic.targets_m.clear();
    for (int t = 0; t < targets; ++t) synthetic.targets_m.push_back(1e-4 * t);
    EXPECT_EQ(of(rig, synthetic.measure())[0].parts().size(), targets == 256 ? 256u : 129u);
  }
}

}  // namespace
}  // namespace mdof::algo
