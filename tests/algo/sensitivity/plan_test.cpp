// Plans as experiments: theory, the effect of each quantity, and the addresses of random numbers.
#include "algo/sensitivity/plan/experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "algo/model/small_angle/small_angle.h"
#include "algo/sensitivity/plan/mounting.h"
#include "schema/base/files.h"
#include "tests/algo/sensitivity/plan_text.h"

namespace mdof::algo {
namespace {

constexpr const char* kFolder = MDOF_TEST_DATA "/sensitivity/";

std::string example(const std::string& name) {
  return read_text_file(kFolder + name + ".toml").value();
}

StudyPlan plan_of(const std::string& text) {
  auto plan = parse_study_plan(text, std::string(kFolder) + "plan.toml");
  EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
  return plan.value_or(StudyPlan{});
}

std::string error_of(const std::string& text) {
  auto plan = parse_study_plan(text, std::string(kFolder) + "plan.toml");
  if (!plan) return plan.error().message;
  auto experiment = make_plan_experiment(*plan);
  return experiment ? "" : experiment.error().message;
}

std::unique_ptr<ScalableExperiment> experiment_of(const std::string& text) {
  auto experiment = make_plan_experiment(plan_of(text));
  EXPECT_TRUE(experiment) << (experiment ? "" : experiment.error().message);
  return experiment ? std::move(*experiment) : nullptr;
}

using Values = std::vector<std::vector<double>>;
using Run = std::function<void(std::span<double* const>)>;

Values values_of(const Experiment& e, std::size_t n, const Run& run) {
  Values values(e.outputs().size(), std::vector<double>(n));
  std::vector<double*> place;
  for (auto& v : values) place.push_back(v.data());
  run(place);
  return values;
}

Values run(const Experiment& e, std::size_t n, std::uint64_t first = 0, std::uint64_t step = 1) {
  return values_of(e, n, [&](auto out) { e.run(first, step, n, out); });
}

struct Figures {
  double mean = 0, sd = 0, sd_se = 0, worst = 0;
};
Figures figures_of(const std::vector<double>& x) {
  Figures f;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) f.mean += v / n;
  double m2 = 0, m4 = 0;
  for (const double v : x) {
    const double d = v - f.mean;
    m2 += d * d / n;
    m4 += d * d * d * d / n;
    f.worst = std::max(f.worst, std::abs(v));
  }
  f.sd = std::sqrt(m2);
  f.sd_se = std::sqrt((m4 - m2 * m2) / n) / (2 * f.sd);
  return f;
}

void expect_sd(const std::vector<double>& x, double sd, const std::string& what) {
  const Figures f = figures_of(x);
  EXPECT_NEAR(f.sd, sd, 5 * f.sd_se + 1e-12) << what;
}

// Text of a plan with the rig and true errors of most tests: the default fixture, d = 30 mm, no
// error motion.
std::string still(const std::string& rest, const std::string& head = "") {
  return "name = \"test\"\nrig = \"../five-probe/rig_X.toml\"\n" + head +
         "\n[truth]\ntravel_mm = [30]\n" + rest;
}

std::string normal(const std::string& name, double sd) {
  return quantity(name, "distribution = \"normal\"\nsd = " + std::to_string(sd));
}
std::string constant(const std::string& name, double value) {
  return quantity(name, "distribution = \"constant\"\nvalue = " + std::to_string(value));
}

constexpr std::size_t kEYX = 0, kEZX = 1, kEAX = 2, kEBX = 3, kECX = 4;

TEST(PlanExperiment, SimulationIAgreesWithTheory) {
  const auto e = experiment_of(example("simulation_1"));
  const auto x = run(*e, 200'000);
  // Theory by algo/sensitivity/README.md: products of two uniform numbers.
  const double l2 = 20e-3;                        // the length l''
  const double a2 = 1e-6 / 3, d2 = 2500e-12 / 3;  // variance of an angle; of an offset
  expect_sd(x[kEAX], 1.0 / 3, "EAX");
  expect_sd(x[kEBX], 1.0 / 3, "EBX");
  expect_sd(x[kECX], 1.0 / 3, "ECX");
  expect_sd(x[kEZX], 1e6 * std::sqrt(a2 * d2), "EZX");  // product -εx δy
  // EYX = u δz + (q - u) l'' with u ≈ εx and q - u ≈ -2 εy εz. Third-order terms are below 20 pm.
  const Figures y = figures_of(x[kEYX]);
  EXPECT_NEAR(y.sd, 1e6 * std::sqrt(a2 * d2 + 4 * l2 * l2 * a2 * a2), 5 * y.sd_se + 2e-5);
  EXPECT_NEAR(figures_of(x[kEAX]).worst, 1.0, 0.02);
}

TEST(PlanExperiment, ForwardModelEqualsTheSmallAngleOutputs) {
  const auto rig = load_rig(MDOF_TEST_DATA "/five-probe/rig_X.toml").value();
  const Fixture fixture = make_fixture(rig).value();
  const auto small = make_small_angle_fixture(fixture).value();
  MountedFixture mounted(fixture, Forward::small_angle, 0.03);
  Mounting nominal;
  nominal.probe.resize(5);
  ASSERT_TRUE(mounted.mount(nominal));
  const Errors5 e = {30e-6, -20e-6, 0.9e-3, -0.7e-3, 0.8e-3};
  const auto expected = exact_outputs(small, 0.043, e);
  std::array<double, 5> got{};
  ASSERT_TRUE(mounted.read(0.043, e, 1, true, got));
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(got[small.probe[k]], expected[k], 1e-17);
}

TEST(PlanExperiment, HasNoErrorWithoutQuantities) {
  for (const char* model : {"exact", "rigid"}) {
    const bool rigid = std::string(model) == "rigid";
    const auto e = experiment_of("name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\nmodel = \"" +
                                 std::string(model) + "\"\nforward = \"" +
                                 (rigid ? "rigid" : "small-angle") + "\"\n");
    for (const auto& x : run(*e, 2000)) EXPECT_LT(figures_of(x).worst, 2e-8) << model;
  }
}

// The rig's height map and plane offset are in the readings and in the solution, so their effects
// must cancel.
TEST(PlanExperiment, HeightMapAndPlaneOffsetCancel) {
  for (const char* const head :
       {"model = \"rigid\"\n", "model = \"rigid\"\nzero_at_start = false\n"}) {
    StudyPlan plan = plan_of(still("", head));
    HeightMap map;
    map.first_m = map.second_m = {-0.1, 0.1};
    map.height_m = {1e-6, 2e-6, 0, 3e-6};
    plan.rig.planes = {{"top", {0, 0, 1}, 1e-5, map}, {"side", {0, 1, 0}, std::nullopt, {}}};
    for (Probe& probe : plan.rig.probes)
      if (probe.direction[2] != 0) probe.position_m[2] = 1e-5;
    auto experiment = make_plan_experiment(plan);
    ASSERT_TRUE(experiment) << experiment.error().message;
    for (const auto& column : run(**experiment, 3))
      for (const double x : column) EXPECT_NEAR(x, 0, 1e-6) << head;
  }
}

TEST(PlanExperiment, NoiseZeroAndDriftPropagateAsInTheModel) {
  // l = 10 mm, d = 30 mm, independent readings with the same u: εx = (B - C)/2l; εy = ((B + C)/2 -
  // A)/l; εz = (E - D)/l.
  const double u = 5;  // nm; an angle of 1 nm/mm is 1 µrad
  for (const char* kind : {"noise_nm", "zero_nm", "drift_nm"}) {
    const auto e = experiment_of(still(normal(std::string("probe.*.") + kind, u)));
    const auto x = run(*e, 50'000);
    expect_sd(x[kEAX], u / 10 / std::sqrt(2.0), kind);
    expect_sd(x[kEBX], u / 10 * std::sqrt(1.5), kind);
    expect_sd(x[kECX], u / 10 * std::sqrt(2.0), kind);
    // δz = (B + C)/2 - d εy = (B + C)/2 (1 - d/l) + A d/l
    expect_sd(x[kEZX], u / 1000 * std::sqrt(2 + 9.0), kind);
    // δy = D + εx l'' + d εz = D (1 - d/l) + E d/l + (B - C) l''/2l
    expect_sd(x[kEYX], u / 1000 * std::sqrt(4 + 9 + 2.0), kind);
  }
}

TEST(PlanExperiment, CommonDriftHardlyChangesTheAngles) {
  const auto e = experiment_of(still(normal("probe.*.drift_nm", 5) +
                                     "[[correlation]]\nquantities = [\"probe.*.drift_nm\"]\n"
                                     "coefficient = 0.8\n"));
  const auto x = run(*e, 50'000);
  // The common part of the drift cancels in differences; 1 - 0.8 of the variance remains.
  expect_sd(x[kEAX], 0.5 * std::sqrt(0.2 / 2), "EAX");
  expect_sd(x[kEBX], 0.5 * std::sqrt(0.2 * 1.5), "EBX");
  // δz is a sum with weights w that have the sum 1. Its variance is u² (0.2 Σ w² + 0.8).
  expect_sd(x[kEZX], 5e-3 * std::sqrt(0.2 * 11 + 0.8), "EZX");
  EXPECT_EQ(e->causes(), std::vector<std::string>{"probe.*.drift_nm"});
}

TEST(PlanExperiment, CorrelatedUniformQuantitiesKeepTheirMarginals) {
  const auto e = experiment_of(
      still(quantity("probe.B.drift_nm", "distribution = \"uniform\"\nhalf_width = 10") +
            quantity("probe.C.drift_nm", "distribution = \"uniform\"\nhalf_width = 10") +
            "[[correlation]]\nquantities = [\"probe.B.drift_nm\", \"probe.C.drift_nm\"]\n"
            "matrix = [[1, 0.5], [0.5, 1]]\n"));
  const auto x = run(*e, 100'000);
  // The values of a Gaussian copula with uniform marginals have the correlation 6/π asin(ρ/2).
  const double rho = 6 / 3.14159265358979 * std::asin(0.25);
  expect_sd(x[kEAX], std::sqrt(2 * (1 - rho) * 100.0 / 3) / 20, "EAX");
  EXPECT_LE(figures_of(x[kEAX]).worst, 1.0);
}

TEST(PlanExperiment, SensitivityScalesTheReading) {
  // At a pitch of 100 µrad and d = 30 mm, A reads (d - l) εy = 2 µm. 1 % of it is 20 nm, which
  // changes the pitch -A/l by 2 µrad.
  const auto e =
      experiment_of(still("EBX_urad = [100]\n" + constant("probe.A.sensitivity_percent", 1)));
  EXPECT_NEAR(run(*e, 1)[kEBX][0], -2.0, 1e-3);
}

TEST(PlanExperiment, PositionErrorsActWithTheAngles) {
  // At a yaw εz of 100 µrad, a side probe E that is 10 µm further along x reads εz 10 µm more: 1
  // nm, which is a yaw of 0.1 µrad.
  const auto shifted = experiment_of(still("ECX_urad = [100]\n" + constant("probe.E.x_um", 10)));
  EXPECT_NEAR(run(*shifted, 1)[kECX][0], 0.1, 1e-4);
  // The position is on a circle, so the effect is 0.1 µrad times a cosine. Its standard deviation
  // is 1/√2 of 0.1 µrad.
  const auto circle =
      experiment_of(still("ECX_urad = [100]\n" + constant("probe.E.position_um", 10)));
  const auto x = run(*circle, 50'000);
  expect_sd(x[kECX], 0.1 / std::sqrt(2.0), "circle");
  EXPECT_NEAR(figures_of(x[kECX]).worst, 0.1, 1e-4);
}

TEST(PlanExperiment, YawedFixtureMixesPitchAndRoll) {
  // The top probes are turned by θ = 2 mrad about z, so 0.2 µrad of a pitch of 100 µrad appear as
  // roll. A probe at (x, y) moves to (x - θy, y + θx). With the pitch p, Δz = -p (x - θy), which
  // contains the roll q̂ = p θ.
  const auto e =
      experiment_of(still("EBX_urad = [100]\n" + constant("installation.top.yaw_mrad", 2)));
  EXPECT_NEAR(run(*e, 1)[kEAX][0], 0.2, 1e-3);
  EXPECT_NEAR(run(*e, 1)[kEBX][0], 0, 1e-3);
}

TEST(PlanExperiment, FixtureOffsetAlongTheMotionTurnsPitchIntoZ) {
  // All probes are 50 µm further along x. The height -p x changes by -100 µrad · 50 µm = -5 nm,
  // which appears as δz.
  const auto e = experiment_of(still("EBX_urad = [100]\n" + constant("installation.x_um", 50)));
  EXPECT_NEAR(run(*e, 1)[kEZX][0], -0.005, 1e-5);
}

TEST(PlanExperiment, TiltedTargetPlaneGivesASlope) {
  // The side plane is yawed by 1 mrad about z: y = h + 1e-3 (x - d) in M. A travel of 30 mm changes
  // the reading by -30 µm.
  const auto side = experiment_of(still(constant("target.side.yaw_mrad", 1)));
  EXPECT_NEAR(run(*side, 1)[kEYX][0], -30, 0.05);
  EXPECT_NEAR(run(*side, 1)[kECX][0], 0, 1e-2);
  const auto top = experiment_of(still(constant("target.top.pitch_mrad", 1)));
  EXPECT_NEAR(run(*top, 1)[kEZX][0], 30, 0.05);
}

TEST(PlanExperiment, FlatnessStaysWithinItsLimit) {
  const auto e = experiment_of(still(constant("target.top.flatness_um", 0.2)));
  const auto x = run(*e, 20'000);
  // εx = (B - C)/2l contains two heights and two zeros, each within ±0.1 µm.
  EXPECT_LT(figures_of(x[kEAX]).worst, 0.4 / 20e-3 + 1e-3);
  EXPECT_GT(figures_of(x[kEAX]).sd, 1);
}

TEST(PlanExperiment, ExpansionIsAboutTheOriginOfM) {
  // The distance of D and E from the origin increases by 10 ppm/K · 2 K · 15 mm = 300 nm towards
  // the target, so both read -0.3 µm.
  const std::string expansion = "[expansion]\nfixture_ppm_per_K = 10\ntarget_ppm_per_K = 10\n";
  const auto fixture = experiment_of(still(constant("temperature.fixture_K", 2) + expansion));
  EXPECT_NEAR(run(*fixture, 1)[kEYX][0], -0.3, 1e-6);
  const auto target = experiment_of(still(constant("temperature.target_K", 2) + expansion));
  EXPECT_NEAR(run(*target, 1)[kEYX][0], 0.3, 1e-6);
}

TEST(PlanExperiment, EncoderErrorsActWithTheAngles) {
  // δz contains -d p: a travel error of 1 µm at a pitch p of 100 µrad changes δz by -0.1 nm.
  const auto offset = experiment_of(still("EBX_urad = [100]\n" + constant("encoder.offset_um", 1)));
  EXPECT_NEAR(run(*offset, 1)[kEZX][0], -1e-4, 1e-6);
  const auto scale =
      experiment_of(still("EBX_urad = [100]\n" + constant("encoder.scale_ppm", 100)));
  EXPECT_NEAR(run(*scale, 1)[kEZX][0], -3e-4, 1e-6);
}

TEST(PlanExperiment, WithoutZeroingTheMountingIsAnError) {
  const std::string lower = constant("probe.A.z_um", 3);
  const auto zeroed = experiment_of(still(lower));
  EXPECT_NEAR(run(*zeroed, 1)[kEBX][0], 0, 1e-6);
  const auto raw = experiment_of(still(lower, "zero_at_start = false\n"));
  EXPECT_NEAR(run(*raw, 1)[kEBX][0], 300, 1e-3);  // A reads -3 µm, so the pitch -A/l is 300 µrad
}

TEST(PlanExperiment, SeriesGiveErrorsOfStraightness) {
  // The sensitivity of both side probes is 1 % too large, so the whole series of δy and its
  // straightness are 1 % too large.
  const auto e = experiment_of(
      "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\n"
      "outputs = [\"EYX_straightness_um\", \"EYX_straightness_end_point_um\"]\n"
      "[truth]\ntravel_mm = [0, 60]\nEYX_um = [10]\n[series]\npositions = 25\n" +
      constant("probe.D.sensitivity_percent", 1) + constant("probe.E.sensitivity_percent", 1));
  for (const auto& x : run(*e, 500)) {
    const Figures f = figures_of(x);
    // The wave of ±10 µm deviates from a line by at most 20 µm peak to valley.
    EXPECT_LT(f.worst, 0.4);
    EXPECT_GT(f.mean, 0.1);
    for (const double v : x) EXPECT_GT(v, 0.05);
  }
}

TEST(PlanExperiment, SquarenessUsesTheArtefactAndBothSlopes) {
  const std::string head =
      "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\noutputs = [\"EC0Y_urad\"]\n"
      "[squareness]\nrig_y = \"../five-probe/rig_Y.toml\"\n"
      "[truth]\ntravel_mm = [0, 60]\nEYX_um = [2]\nEXY_um = [2]\n";
  const auto square = experiment_of(head + constant("target.square_urad", 5));
  EXPECT_NEAR(run(*square, 1)[0][0], 5, 1e-3);
  // A side plane that is yawed by 100 µrad gives δy a slope of -100 µrad for X. For Y, δy is -EXY,
  // so EXY has a slope of +100 µrad. Both slopes cancel in -slope(EXY) - slope(EYX).
  const auto yawed = experiment_of(head + constant("target.side.yaw_mrad", 0.1));
  EXPECT_NEAR(run(*yawed, 1)[0][0], 0, 1e-2);
}

TEST(PlanExperiment, AnotherQuantityChangesNoOtherNumber) {
  const auto one = experiment_of(still(normal("probe.A.x_um", 2)));
  const auto two = experiment_of(still(normal("probe.B.noise_nm", 2) + normal("probe.A.x_um", 2)));
  const auto a = one->inputs(17), b = two->inputs(17);
  EXPECT_EQ(a.back(), b.back());
  EXPECT_EQ(a.back().first, "probe.A.x_um");
  EXPECT_NE(one->inputs(18).back().second, a.back().second);
}

std::unique_ptr<ScalableExperiment> mounting() {
  return experiment_of(example("mounting"));
}

TEST(PlanExperiment, SingleTrialEqualsTheBatch) {
  const auto e = mounting();
  const auto all = run(*e, 300, 1000);
  for (const std::size_t j : {0U, 127U, 128U, 299U}) {
    const auto alone = run(*e, 1, 1000 + j);
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(alone[k][0], all[k][j]);
  }
  const auto strided = run(*e, 20, 1001, 12);
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(strided[k][3], all[k][37]);
}

TEST(PlanExperiment, MixingNothingAndScalingByOneKeepTheBits) {
  const auto e = mounting();
  const auto plain = run(*e, 50);
  std::vector<std::uint8_t> second(e->causes().size(), 0);
  const auto mixed = values_of(*e, 50, [&](auto out) { e->run_mixed(second, 0, 1, 50, out); });
  EXPECT_EQ(mixed, plain);
  const std::vector<double> scale(e->quantities().size(), 1.0);
  const auto scaled = values_of(*e, 50, [&](auto out) { e->run_scaled(scale, 0, 1, 50, out); });
  EXPECT_EQ(scaled, plain);
  std::fill(second.begin(), second.end(), std::uint8_t{1});
  const auto other = values_of(*e, 50, [&](auto out) { e->run_mixed(second, 0, 1, 50, out); });
  EXPECT_NE(other, plain);
}

TEST(PlanExperiment, TrialsAreInTheirBins) {
  const auto e = mounting();
  ASSERT_EQ(e->binned().bins, 12U);
  EXPECT_EQ(e->binned().to, 60);
  for (std::uint64_t trial = 0; trial < 48; ++trial) {
    const double travel = e->inputs(trial)[0].second;
    EXPECT_EQ(e->inputs(trial)[0].first, "travel_mm");
    EXPECT_EQ(static_cast<std::uint64_t>(travel / 5), trial % 12);
  }
}

// Stored bits of the results of a plan. They may change only if the meaning of a plan changes.
TEST(PlanExperiment, HasTheSameBitsInEveryBuild) {
  const auto e = mounting();
  std::uint64_t hash = 14695981039346656037U;
  for (const auto& x : run(*e, 500)) {
    for (const double v : x) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &v, sizeof bits);
      hash = (hash ^ bits) * 1099511628211U;
    }
  }
  EXPECT_EQ(hash, 15719322836937508599U);
}

TEST(PlanExperiment, RejectsPlansThatCannotBeEvaluated) {
  const std::string blind = error_of("name = \"t\"\nrig = \"rig_blind.toml\"\n");
  EXPECT_NE(blind.find("plan.toml: rig: "), std::string::npos) << blind;
  EXPECT_NE(blind.find("cannot"), std::string::npos) << blind;
  const std::string matrix =
      error_of(still(normal("probe.*.drift_nm", 5) +
                     "[[correlation]]\nquantities = [\"probe.*.drift_nm\"]\ncoefficient = -0.5\n"));
  EXPECT_NE(matrix.find("plan.toml:"), std::string::npos) << matrix;
  EXPECT_NE(matrix.find("smallest eigenvalue is -1"), std::string::npos) << matrix;
  const std::string cold = error_of(still(constant("temperature.target_K", 5)));
  EXPECT_NE(cold.find("target_ppm_per_K"), std::string::npos) << cold;
  const std::string map = error_of(still(constant("target.top.map_percent", 5)));
  EXPECT_NE(map.find("no flatness map"), std::string::npos) << map;
  const std::string noise = error_of(
      "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\noutputs = [\"EYX_straightness_um\"]\n" +
      normal("probe.A.drift_nm", 5) + normal("probe.A.noise_nm", 5) +
      "[[correlation]]\nquantities = [\"probe.A.drift_nm\", \"probe.A.noise_nm\"]\n"
      "coefficient = 0.5\n");
  EXPECT_NE(noise.find("one of the two is noise"), std::string::npos) << noise;
}

}  // namespace
}  // namespace mdof::algo
