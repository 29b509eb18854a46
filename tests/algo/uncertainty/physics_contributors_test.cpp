// Compares the effects of declared uncertainties of tilts, probe curves and ambient conditions with
// the formulas of algo/README.md. A tilt t of the target brings it nearer by k r² t²/(4 gap).
// A change of the permittivity of the air changes all gaps by the same factor. With l = 10 mm, a
// change c of the reading of B changes the roll by c/2l, a change c of D changes the yaw by -c/l,
// and equal changes c of A, B and C change the height by c.
#include "algo/uncertainty/physics_contributors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kArm_m = 0.010, kGap_m = 250e-6, kDisc_m2 = 2e-3 * 2e-3;
constexpr std::size_t kOfB = 1, kOfD = 3;
const std::string kGapKeys = "sensing_radius_mm = 2\nstandoff_um = 250\ntilt_factor = 5\n";
const std::string kCalibrationConditions =
    "calibration_temperature_C = 20\ncalibration_pressure_kPa = 101.325\n"
    "calibration_humidity_percent = 40\n";
const std::string kMeasuringConditions =
    "temperature_C = 23\npressure_kPa = 99\nhumidity_percent = 65\n";

// A rig with `keys` added to each probe, and `of_b` added to probe B.
Rig declared_physics_rig(const std::string& keys, const std::string& of_b, const std::string& end,
                         const std::string& measures_of_b = "measures = \"+Z\"") {
  std::string toml = test::rig_x_toml();
  for (const char id : {'A', 'B', 'C', 'D', 'E'}) {
    const std::size_t at = toml.find('\n', toml.find(std::string("id = \"") + id + "\"")) + 1;
    toml.insert(at, keys + (id == 'B' ? of_b : ""));
  }
  const std::string measures = "measures = \"+Z\"";
  const std::size_t b = toml.find(measures, toml.find("id = \"B\""));
  toml.replace(b, measures.size(), measures_of_b);
  auto rig = parse_rig(toml + end, "rig.toml");
  EXPECT_TRUE(rig) << rig.error().message;
  return rig.value_or(Rig());
}

// Roll, pitch and yaw are proportional to the travel d: 1, 2 and 3 mrad at 40 mm.
Errors5 tilting_axis(double d) {
  return {0, 0, 1e-3 * d / 0.04, 2e-3 * d / 0.04, 3e-3 * d / 0.04};
}
// Both straightness errors are linear in d; there are no angles.
Errors5 rising_axis(double d) {
  return {3e-6 + 1e-4 * d, 20e-6 - 2e-4 * d, 0, 0, 0};
}
Run simulated_physics_run(const Rig& rig, Errors5 (*truth)(double)) {
  return SyntheticRun{.rig = rig, .runs = 1, .truth = truth}.measure();
}

// Returns the contributor with this name. If no contributor has this name, the test fails.
Contributor named_contributor(const Rig& rig, const Run& run, const std::string& name) {
  auto all = contributors(rig, run).value();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& c) { return contributor_text(c.name) == name; });
  EXPECT_TRUE(found != all.end()) << name;
  return found == all.end() ? Contributor() : *found;
}
bool has_contributor(const Rig& rig, const Run& run, const std::string& name) {
  const auto all = contributors(rig, run).value();
  return std::any_of(all.begin(), all.end(),
                     [&](const auto& c) { return contributor_text(c.name) == name; });
}
void expect_shown(const Contributor& c, const char* key, double value, const char* unit) {
  EXPECT_EQ(c.key, key);
  EXPECT_NEAR(c.declared.u * c.to_unit, value, 1e-9 * value);
  EXPECT_EQ(c.unit, unit);
}

// Change of the reading of B or D that causes the change `shift` of the errors, m.
double reading_b_shift(const Errors5& shift) {
  return shift[kEx] * 2 * kArm_m;
}
double reading_d_shift(const Errors5& shift) {
  return -shift[kEz] * kArm_m;
}
double expected_gap_m(const Run& run, std::size_t j, std::size_t probe) {
  return kGap_m - run.points[j].point.probe_m[probe];
}

// Only roll and pitch tilt the target against B, only roll and yaw against D.
void expect_tilts(const Contributor& of_b, const Contributor& of_d, const Run& run, double u) {
  const auto b = of_b.parts(), d = of_d.parts();
  ASSERT_EQ(b.size(), 1u);
  ASSERT_EQ(d.size(), 1u);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double part = run.points[j].point.position_m / 0.04, square = part * part * 1e-6;
    const double by_b = u * kDisc_m2 * 5 * square / (4 * expected_gap_m(run, j, kOfB));
    const double by_d = u * kDisc_m2 * 10 * square / (4 * expected_gap_m(run, j, kOfD));
    EXPECT_NEAR(reading_b_shift(b[0][j]), by_b, 0.02 * by_b + 1e-15) << j;
    EXPECT_NEAR(reading_d_shift(d[0][j]), by_d, 0.02 * by_d + 1e-15) << j;
  }
}

TEST(PhysicsContributors, CorrectedTiltHasTheUOfItsFactor) {
  const Rig rig =
      declared_physics_rig(kGapKeys + "u_tilt_factor = 0.4\n", "", "[corrections]\ntilt = true\n");
  const mdof::Run run = simulated_physics_run(rig, tilting_axis);
  const Contributor b = named_contributor(rig, run, "probe B: tilt");
  expect_shown(b, "u_tilt_factor", 0.4, "");
  expect_tilts(b, named_contributor(rig, run, "probe D: tilt"), run, 0.4);
  EXPECT_FALSE(has_contributor(rig, run, "probe B: tilt in its clamp"));
  EXPECT_FALSE(has_contributor(rig, run, "probe B: linearity"));
}

TEST(PhysicsContributors, UncorrectedTiltContributesItsWholeEffect) {
  const Rig rig =
      declared_physics_rig(kGapKeys + "u_tilt_factor = 0.4\n", "", "[corrections]\ntilt = false\n");
  const mdof::Run run = simulated_physics_run(rig, tilting_axis);
  const Contributor b = named_contributor(rig, run, "probe B: uncorrected tilt");
  const double whole = std::sqrt(5 * 5 + 0.4 * 0.4);
  expect_shown(b, "tilt_factor", whole, "");
  expect_tilts(b, named_contributor(rig, run, "probe D: uncorrected tilt"), run, whole);
}

// Probe B is misaligned by 20 mrad against the normal of its plane. The effect of the tilt factor
// is proportional to the change of the tilt term since the probe was zeroed.
constexpr double kMisalignment_rad = 0.02;
const std::string kCorrectedOverPlanes =
    "[corrections]\ntilt = true\n[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n"
    "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n";
struct MisalignedProbe {
  double gap_m, roll, pitch;
  // Sum of the squares of the angle components between the normal of the plane and the probe; the
  // components are across the probe.
  double square() const {
    return ((roll + kMisalignment_rad) * (roll + kMisalignment_rad) + pitch * pitch) /
           (1 + kMisalignment_rad * kMisalignment_rad);
  }
};
constexpr double kMisalignmentSquare =
    kMisalignment_rad * kMisalignment_rad / (1 + kMisalignment_rad * kMisalignment_rad);
MisalignedProbe misaligned_probe(const Run& run, std::size_t j) {
  const double part = run.points[j].point.position_m / 0.04;
  return {expected_gap_m(run, j, kOfB), 1e-3 * part, 2e-3 * part};
}

TEST(PhysicsContributors, TiltActsByItsChangeSinceZeroing) {
  const Rig rig = declared_physics_rig(kGapKeys, "u_tilt_factor = 0.4\n", kCorrectedOverPlanes,
                                       "direction = [0, 0.02, 1]");
  const mdof::Run run = simulated_physics_run(rig, tilting_axis);
  const auto parts = named_contributor(rig, run, "probe B: tilt").parts();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const MisalignedProbe b = misaligned_probe(run, j);
    const double expected =
        0.4 * kDisc_m2 / 4 * (b.square() / b.gap_m - kMisalignmentSquare / kGap_m);
    EXPECT_NEAR(reading_b_shift(parts[0][j]), expected, 0.02 * std::abs(expected) + 1e-15) << j;
  }
}

// With a tilt c of 3 mrad of the probe in its clamp, the tilt term is (t + c)². It contains 2 t c
// for each of two axes, and c² of both axes.
TEST(PhysicsContributors, ProbeMayBeTiltedInItsClamp) {
  const Rig rig = declared_physics_rig(kGapKeys, "u_direction_mrad = 3\n", kCorrectedOverPlanes,
                                       "direction = [0, 0.02, 1]");
  const mdof::Run run = simulated_physics_run(rig, tilting_axis);
  const Contributor found = named_contributor(rig, run, "probe B: tilt in its clamp");
  expect_shown(found, "u_direction_mrad", 3, "mrad");
  EXPECT_FALSE(has_contributor(rig, run, "probe D: tilt in its clamp"));
  const auto parts = found.parts();
  ASSERT_EQ(parts.size(), 3u);
  const double c = 3e-3, norm = std::sqrt(1 + kMisalignment_rad * kMisalignment_rad);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const MisalignedProbe b = misaligned_probe(run, j);
    const double about_x =
        -(b.roll + kMisalignment_rad) / norm / b.gap_m + kMisalignment_rad / norm / kGap_m;
    const double about_y = -b.pitch / b.gap_m;  // the axis of the probe is not exactly z: 2e-4
    const double expected = 5 * kDisc_m2 / 4 * 2 * c * std::hypot(about_x, about_y);
    const double both = std::hypot(reading_b_shift(parts[0][j]), reading_b_shift(parts[1][j]));
    EXPECT_NEAR(both, expected, 0.02 * expected + 1e-15) << j;
    const double of_square = 5 * kDisc_m2 / 4 * 2 * c * c * (1 / b.gap_m - 1 / kGap_m);
    EXPECT_NEAR(reading_b_shift(parts[2][j]), of_square, 0.02 * std::abs(of_square) + 1e-15) << j;
  }
}

// The declared error is a sum of four waves. Their lengths are the range and a half, a third and a
// fourth of the range; their weights are 1, 1/4, 1/9 and 1/16. At each reading the sum of their
// squares is u².
TEST(PhysicsContributors, LinearityIsASumOfWavesOverTheRange) {
  const Rig rig = declared_physics_rig("", "u_linearity_um = 0.05\n", "");
  const mdof::Run run = simulated_physics_run(rig, tilting_axis);
  const Contributor found = named_contributor(rig, run, "probe B: linearity");
  expect_shown(found, "u_linearity_um", 0.05, "µm");
  const auto parts = found.parts();
  ASSERT_EQ(parts.size(), 8u);
  const double norm = 1 + 1 / 16. + 1 / 81. + 1 / 256.;
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double turn = 2 * std::numbers::pi * run.points[j].point.probe_m[kOfB] / 200e-6;
    double square = 0;
    for (std::size_t w = 1; w <= 4; ++w) {
      const auto wave = static_cast<double>(w);
      const double size = 0.05e-6 / (wave * wave * std::sqrt(norm));
      const double sine = reading_b_shift(parts[2 * w - 2][j]),
                   cosine = reading_b_shift(parts[2 * w - 1][j]);
      EXPECT_NEAR(sine, size * std::sin(wave * turn), 0.02 * size) << j << ' ' << w;
      EXPECT_NEAR(cosine, size * std::cos(wave * turn), 0.02 * size) << j << ' ' << w;
      square += sine * sine + cosine * cosine;
    }
    EXPECT_NEAR(std::sqrt(square), 0.05e-6, 0.02 * 0.05e-6);
  }
}

// s is the reading. The omitted correction is a polynomial of s, a polynomial of -s if the probe
// reads gaps, or straight lines between given pairs.
TEST(PhysicsContributors, UncorrectedCurveContributesItsWholeEffect) {
  const std::string off = "[corrections]\nlinearity = false\n";
  const struct {
    std::string keys;
    const char* key;
    double (*correction_um)(double s_um);
  } cases[] = {{"polynomial_um = [0.2, 0.01, 0.0003]\n", "polynomial_um",
                [](double s) { return 0.2 + 0.01 * s + 0.0003 * s * s; }},
               {"polynomial_um = [0.2, 0.01, 0.0003]\nreads = \"gap\"\noffset_um = 100\n",
                "polynomial_um", [](double s) { return -(0.2 - 0.01 * s + 0.0003 * s * s); }},
               {"linearity = [[-100, -0.3], [0, 0.1], [100, 0.6]]\n", "linearity",
                [](double s) { return 0.1 + s * (s < 0 ? 0.004 : 0.005); }}};
  for (const auto& c : cases) {
    const Rig rig = declared_physics_rig("", c.keys, off);
    mdof::Run run = simulated_physics_run(rig, rising_axis);
    run.points.resize(9);  // forward only: the first reading alone is the largest
    const Contributor found = named_contributor(rig, run, "probe B: uncorrected linearity");
    EXPECT_FALSE(has_contributor(rig, run, "probe C: uncorrected linearity"));
    const auto parts = found.parts();
    double most_um = 0;
    for (std::size_t j = 0; j < run.points.size(); ++j) {
      const double s_um = run.points[j].point.probe_m[kOfB] * 1e6;
      EXPECT_NEAR(reading_b_shift(parts[0][j]) * 1e6, c.correction_um(s_um), 1e-5)
          << c.keys << s_um;
      most_um = std::max(most_um, std::abs(c.correction_um(s_um)));
    }
    expect_shown(found, c.key, most_um, "µm");
  }
}

// ε - 1 = 2e-6 (776 p/T + 3.73e6 e/T²) with the pressure p and the vapour pressure e in kPa; e is
// calculated by the formula of Magnus.
double independent_permittivity(double t_C, double p_kPa, double humidity) {
  const double T = t_C + 273.15,
               e_kPa = humidity / 100 * 0.61094 * std::exp(17.625 * t_C / (t_C + 243.04));
  return 1 + 2e-6 * (776 * p_kPa / T + 3.73e6 * e_kPa / (T * T));
}
struct AirState {
  double t_C, p_kPa, humidity;
  double slope(int quantity) const {
    const double step[] = {quantity == 0 ? 0.1 : 0, quantity == 1 ? 0.1 : 0,
                           quantity == 2 ? 0.1 : 0};
    return (independent_permittivity(t_C + step[0], p_kPa + step[1], humidity + step[2]) -
            independent_permittivity(t_C - step[0], p_kPa - step[1], humidity - step[2])) /
           0.2;
  }
};
constexpr AirState kAtCalibration = {20, 101.325, 40}, kNow = {23, 99, 65};

// Expects that the gaps of all probes are longer by the fraction `relative`.
void expect_gaps_longer(const Contributor& c, const Run& run, double relative) {
  const auto parts = c.parts();
  ASSERT_EQ(parts.size(), 1u);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const Errors5 truth = rising_axis(run.points[j].point.position_m);
    const double dy = -relative * (kGap_m - truth[kDy]), dz = -relative * (kGap_m - truth[kDz]);
    EXPECT_NEAR(parts[0][j][kDy], dy, 0.01 * std::abs(dy)) << contributor_text(c.name);
    EXPECT_NEAR(parts[0][j][kDz], dz, 0.01 * std::abs(dz)) << contributor_text(c.name);
    for (const auto angle : {kEx, kEy, kEz})
      EXPECT_NEAR(parts[0][j][angle], 0, 1e-12) << contributor_text(c.name);
  }
}

constexpr const char* kQuantity[] = {"temperature", "pressure", "humidity"};
constexpr const char* kQuantityKey[] = {"temperature_C", "pressure_kPa", "humidity_percent"};
constexpr const char* kQuantityUnit[] = {"°C", "kPa", "%"};
constexpr double kUAtMeasurement[] = {1, 0.5, 5}, kUAtCalibration[] = {0.7, 0.3, 4};
const std::string kAirUncertainties =
    "u_temperature_C = 1\nu_pressure_kPa = 0.5\nu_humidity_percent = 5\n"
    "u_calibration_temperature_C = 0.7\nu_calibration_pressure_kPa = 0.3\n"
    "u_calibration_humidity_percent = 4\n";

void expect_air_quantities(const Rig& rig, const Run& run, const AirState& slopes_at) {
  for (int q = 0; q < 3; ++q) {
    const auto name = std::string(kQuantity[q]), key = std::string(kQuantityKey[q]);
    const Contributor now = named_contributor(rig, run, "air: " + name);
    expect_shown(now, ("u_" + key).c_str(), kUAtMeasurement[q], kQuantityUnit[q]);
    expect_gaps_longer(now, run, kUAtMeasurement[q] * slopes_at.slope(q));
    const Contributor then = named_contributor(rig, run, "air during the calibration: " + name);
    expect_shown(then, ("u_calibration_" + key).c_str(), kUAtCalibration[q], kQuantityUnit[q]);
    expect_gaps_longer(then, run, -kUAtCalibration[q] * kAtCalibration.slope(q));
  }
}

TEST(PhysicsContributors, CorrectedAirHasTheUOfItsConditions) {
  const Rig rig =
      declared_physics_rig(kGapKeys, "",
                           "[corrections]\ndielectric = true\n[air]\n" + kCalibrationConditions +
                               kMeasuringConditions + kAirUncertainties);
  const mdof::Run run = simulated_physics_run(rig, rising_axis);
  EXPECT_FALSE(has_contributor(rig, run, "air: uncorrected permittivity"));
  expect_air_quantities(rig, run, kNow);
}

TEST(PhysicsContributors, UncorrectedAirContributesItsWholeEffect) {
  const Rig rig =
      declared_physics_rig(kGapKeys, "",
                           "[corrections]\ndielectric = false\n[air]\n" + kCalibrationConditions +
                               kMeasuringConditions + kAirUncertainties);
  const mdof::Run run = simulated_physics_run(rig, rising_axis);
  const Contributor whole = named_contributor(rig, run, "air: uncorrected permittivity");
  const double relative =
      independent_permittivity(23, 99, 65) / independent_permittivity(20, 101.325, 40) - 1;
  EXPECT_EQ(whole.key, "[air]");
  EXPECT_EQ(whole.unit, "ppm");
  EXPECT_NEAR(whole.declared.u * whole.to_unit, std::abs(relative) * 1e6, 0.3);
  const auto parts = whole.parts();
  ASSERT_EQ(parts.size(), 1u);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double gap_m = kGap_m - rising_axis(run.points[j].point.position_m)[kDz];
    EXPECT_NEAR(std::abs(parts[0][j][kDz]), std::abs(relative) * gap_m, 0.3e-6 * gap_m);
  }
  expect_air_quantities(rig, run, kNow);
}

// The rig declares no ambient conditions because the log contains them. The sensitivities are then
// calculated at the conditions of the calibration.
TEST(PhysicsContributors, AirFromTheLogHasTheSlopesOfTheCalibration) {
  const Rig rig = declared_physics_rig(
      kGapKeys, "",
      "[corrections]\ndielectric = false\n[air]\n" + kCalibrationConditions + kAirUncertainties);
  const mdof::Run run = simulated_physics_run(rig, rising_axis);
  EXPECT_FALSE(has_contributor(rig, run, "air: uncorrected permittivity"));
  expect_air_quantities(rig, run, kAtCalibration);
  // The sensitivities are also calculated there if the log contains one of the quantities.
  const Rig partly =
      declared_physics_rig(kGapKeys, "",
                           "[corrections]\ndielectric = false\n[air]\n" + kCalibrationConditions +
                               "temperature_C = 23\nhumidity_percent = 65\n" + kAirUncertainties);
  EXPECT_FALSE(has_contributor(partly, run, "air: uncorrected permittivity"));
}

TEST(PhysicsContributors, PointsWithoutErrorsHaveZeroEffect) {
  const Rig rig =
      declared_physics_rig(kGapKeys, "",
                           "[corrections]\ndielectric = true\n[air]\n" + kCalibrationConditions +
                               kMeasuringConditions + kAirUncertainties);
  mdof::Run run = simulated_physics_run(rig, rising_axis);
  run.points[3].errors.valid = false;
  const auto parts = named_contributor(rig, run, "air: pressure").parts();
  EXPECT_EQ(parts[0][3], Errors5{});
  EXPECT_NE(parts[0][2], Errors5{});
  EXPECT_NE(parts[0][4], Errors5{});
}

}  // namespace
}  // namespace mdof::algo
