#include "schema/rig/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/rig/rig.h"
#include "tests/algo/rigs.h"

namespace mdof {
namespace {

// The default rig. `keys` are added to probe A, `end` is added at the end.
Result<Rig> rig(const std::string& keys, const std::string& end = "") {
  std::string toml = test::rig_x_toml();
  toml.insert(toml.find('\n', toml.find("id = \"A\"")) + 1, keys + "\n");
  return parse_rig(toml + end, "rig.toml");
}

std::string refusal(const std::string& keys, const std::string& end = "") {
  const auto parsed = rig(keys, end);
  EXPECT_FALSE(parsed) << keys << end;
  return parsed ? "" : parsed.error().message;
}

TEST(RigUncertainty, ReadsEachKeyInItsUnit) {
  const auto parsed = rig(
      "u_calibration_um = 0.05\nu_sensitivity_ppm = 200\nu_position_mm = [0.1, 0.2, 0.3]\n"
      "u_direction_mrad = 2",
      "[encoder]\nu_um = 0.4\n[installation]\nu_angle_mrad = [1, 2, 3]\nu_offset_mm = 0.05\n"
      "[drift]\nu_um_per_h = 0.36\n[temperature]\nu_scale_K = 0\n"
      "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = 0.03\nflatness_length_mm = 12\n"
      "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n");
  ASSERT_TRUE(parsed) << parsed.error().message;
  const ProbeUncertainty& a = parsed->probes[0].uncertainty;
  EXPECT_DOUBLE_EQ(a.calibration.u, 0.05e-6);
  EXPECT_DOUBLE_EQ(a.sensitivity.u, 200e-6);
  EXPECT_DOUBLE_EQ(a.position.u[1], 0.2e-3);
  EXPECT_DOUBLE_EQ(a.direction.u, 2e-3);
  EXPECT_EQ(a.direction.shape, UncertaintyShape::normal);
  EXPECT_TRUE(std::isinf(a.direction.freedom));
  EXPECT_FALSE(parsed->probes[1].uncertainty.calibration.declared());
  EXPECT_DOUBLE_EQ(parsed->uncertainty.encoder.u, 0.4e-6);
  EXPECT_FALSE(parsed->encoder_um_per_V);
  EXPECT_EQ(parsed->encoder_delay_s, 0);
  EXPECT_DOUBLE_EQ(parsed->uncertainty.installation_angle.u[2], 3e-3);
  EXPECT_DOUBLE_EQ(parsed->uncertainty.installation_offset.u[2], 0.05e-3);
  EXPECT_DOUBLE_EQ(parsed->uncertainty.drift.u, 1e-10);
  EXPECT_DOUBLE_EQ(parsed->planes[0].u_flatness.u, 0.03e-6);
  EXPECT_DOUBLE_EQ(parsed->planes[0].flatness_length_m, 0.012);
  EXPECT_DOUBLE_EQ(parsed->planes[1].flatness_length_m, 0.030);
  // The second plane and the probes B to E do not declare these uncertainties, and the keys of
  // [temperature] are missing.
  EXPECT_EQ(
      parsed->undeclared_uncertainties(),
      (std::vector<std::string>{"u_calibration_um", "u_sensitivity_ppm", "u_position_mm",
                                "u_direction_mrad", "u_flatness_um", "[temperature] u_fixture_K",
                                "[temperature] u_square_gradient_K_per_m"}));
  EXPECT_EQ(rig("")->undeclared_uncertainties().size(), 12u);
}

// u of a distribution with half-width a:
// - rectangular: a/√3 (GUM 4.3.7)
// - triangular: a/√6 (GUM 4.3.9)
// - arcsine: a/√2
TEST(RigUncertainty, LimitsBecomeAStandardUncertainty) {
  const auto u = [](const std::string& table) {
    return rig("u_calibration_um = " + table)->probes[0].uncertainty.calibration;
  };
  EXPECT_NEAR(u("{ half_width = 0.3, distribution = \"rectangular\" }").u, 0.3e-6 / 1.7320508,
              1e-13);
  EXPECT_NEAR(u("{ half_width = 0.3, distribution = \"triangular\" }").u, 0.3e-6 / 2.4494897,
              1e-13);
  EXPECT_NEAR(u("{ half_width = 0.3, distribution = \"u-shaped\" }").u, 0.3e-6 / 1.4142136, 1e-13);
  const auto with_freedom = u("{ u = 0.3, dof = 8, distribution = \"rectangular\" }");
  EXPECT_DOUBLE_EQ(with_freedom.u, 0.3e-6);
  EXPECT_EQ(with_freedom.shape, UncertaintyShape::rectangular);
  EXPECT_EQ(with_freedom.freedom, 8);
  const auto three = rig("u_position_mm = { u = [1, 2, 3], distribution = \"triangular\" }");
  EXPECT_DOUBLE_EQ(three->probes[0].uncertainty.position.component(2).u, 3e-3);
}

TEST(RigUncertainty, ErrorsStateThePlaceOfInvalidValues) {
  const struct {
    const char *keys, *says;
  } cases[] = {
      {"u_calibration_um = -0.1", "rig.toml:5: probe[1].u_calibration_um"},
      {"u_calibration_um = nan", "finite number"},
      {"u_calibration_um = inf", "finite number"},
      {"u_calibration_um = [1, 2]", "one number"},
      {"u_position_mm = [1, 2]", "three numbers"},
      {"u_position_mm = []", "u_position_mm: must not be empty"},
      {"u_position_mm = { u = [] }", "u_position_mm: must not be empty"},
      {"u_calibration_um = { half_width = 1 }", "normal distribution has no limits"},
      {"u_calibration_um = { u = 1, half_width = 1, distribution = \"rectangular\" }",
       "either \"u\""},
      {"u_calibration_um = { distribution = \"rectangular\" }", "either \"u\""},
      {"u_calibration_um = { u = 1, distribution = \"square\" }", "not one of \"normal\""},
      {"u_calibration_um = { u = 1, dof = 0 }", "degrees of freedom"},
      {"u_calibration_um = { u = 1, half = 2 }", "half"},
      {"u_calibration_mm = 1", "u_calibration_um"},
  };
  for (const auto& c : cases)
    EXPECT_NE(refusal(c.keys).find(c.says), std::string::npos) << c.keys << ": " << refusal(c.keys);
  EXPECT_NE(refusal("", "[encoder]\n").find("um_per_V"), std::string::npos);
  EXPECT_NE(
      refusal("", "[encoder]\ndelay_us = -8000\n").find("delay of the readings of the encoder"),
      std::string::npos);
  const auto thermal = [](const std::string& keys) {
    return refusal("", "[temperature]\n" + keys);
  };
  EXPECT_NE(thermal("u_scale_K = 1\n").find("temperature.scale_ppm_per_K"), std::string::npos);
  EXPECT_NE(thermal("fixture_C = 23\n").find("fixture_ppm_per_K"), std::string::npos);
  EXPECT_NE(thermal("fixture_C = 293.15\n").find("degrees Celsius"), std::string::npos);
  EXPECT_NE(thermal("scale_ppm_per_K = 1e4\n").find("1e-6/K"), std::string::npos);
  EXPECT_NE(thermal("square_ppm_per_K = 9\nu_square_ppm_per_K = -1\n").find("from 0 to 1000"),
            std::string::npos);
  EXPECT_NE(thermal("u_square_gradient_K_per_m = [1, 2]\nsquare_ppm_per_K = 9\n").find("three"),
            std::string::npos);
  EXPECT_NE(refusal("", "[drift]\nu_um = 1\n").find("u_um_per_h"), std::string::npos);
  EXPECT_NE(refusal("", "[[plane]]\nnormal = \"+Z\"\nflatness_length_mm = 0\n").find("from 0.1"),
            std::string::npos);
}

// A larger value has a wrong unit. The limits are far above the values of real fixtures.
TEST(RigUncertainty, LimitsEachUncertainty) {
  const struct {
    std::string table, key;
    double most;
  } cases[] = {{"", "u_calibration_um", 1e4},
               {"", "u_sensitivity_ppm", 5e5},
               {"", "u_position_mm", 100},
               {"", "u_direction_mrad", 500},
               {"", "u_linearity_um", 1e4},
               {"[encoder]", "u_um", 1e4},
               {"[installation]", "u_angle_mrad", 500},
               {"[installation]", "u_offset_mm", 100},
               {"[drift]", "u_um_per_h", 1e4},
               {"[drift]", "limit_um_per_h", 1e4},
               {"[temperature]\nscale_ppm_per_K = 9", "u_scale_K", 100},
               {"[temperature]\nsquare_ppm_per_K = 9", "u_square_gradient_K_per_m", 1000},
               {"[[plane]]\nnormal = \"+Z\"", "u_flatness_um", 1e4}};
  for (const auto& c : cases) {
    const auto with = [&](const std::string& value) {
      const std::string line = c.key + " = " + value + "\n";
      return c.table.empty() ? rig(line) : rig("", c.table + "\n" + line);
    };
    const auto most = with(std::to_string(c.most));
    EXPECT_TRUE(most) << c.key << ": " << most.error().message;
    for (const char* value : {"1e300", "-1"}) {
      const auto refused = with(value);
      ASSERT_FALSE(refused) << c.key;
      EXPECT_NE(refused.error().message.find(c.key + ": must be"), std::string::npos)
          << refused.error().message;
    }
    EXPECT_FALSE(with(std::to_string(c.most * 1.01))) << c.key;
  }
  EXPECT_NE(refusal("u_direction_mrad = 2000").find("from 0 to 500, not 2000; check the unit"),
            std::string::npos);
}

// has() does not count as reading. A key that is only checked with has() is rejected as unknown,
// but mdof still suggests this key for a similar misspelt key.
TEST(TomlTable, KeyCheckedWithHasIsNotRead) {
  auto there = TomlTable::parse("drift = 1\n", "f.toml").value();
  EXPECT_TRUE(there.has("drift"));
  const Status unread = there.finish();
  ASSERT_FALSE(unread);
  EXPECT_NE(unread.error().message.find("drift: unknown key"), std::string::npos);
  auto misspelt = TomlTable::parse("drifd = 1\n", "f.toml").value();
  EXPECT_FALSE(misspelt.has("drift"));
  EXPECT_NE(misspelt.finish().error().message.find("did you mean \"drift\""), std::string::npos);
}

}  // namespace
}  // namespace mdof
