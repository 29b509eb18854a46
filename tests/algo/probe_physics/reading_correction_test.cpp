// Published formulas give readings with the errors of a tilt and of the permittivity of air. The
// tests check the errors that remain after the correction, and whether the stated uncertainty
// covers unknown parameters.
#include "algo/probe_physics/reading_correction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/uncertainty/run_uncertainty.h"
#include "schema/sample.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kRadius_m = 2e-3, kStandoff_m = 250e-6;

std::string physics_toml(const std::string& corrections) {
  std::string toml = test::rig_x_toml();
  for (std::size_t at = 0; (at = toml.find("range_um", at)) != std::string::npos;) {
    const std::string keys =
        "sensing_radius_mm = 2\nstandoff_um = 250\ntilt_factor = 5\n"
        "u_tilt_factor = 0.4\nu_linearity_um = 0.002\n";
    toml.insert(at, keys);
    at += keys.size() + 8;
  }
  return toml + corrections +
         "[air]\ncalibration_temperature_C = 20\ncalibration_pressure_kPa = 101.325\n"
         "calibration_humidity_percent = 40\ntemperature_C = 23\npressure_kPa = 99\n"
         "humidity_percent = 65\nu_temperature_C = 1\nu_humidity_percent = 5\n"
         "u_pressure_kPa = 0.5\n";
}

Rig physics_rig(const std::string& corrections) {
  auto rig = parse_rig(physics_toml(corrections), "rig.toml");
  EXPECT_TRUE(rig) << rig.error().message;
  return rig.value_or(Rig());
}

const std::string kBoth = "[corrections]\ntilt = true\ndielectric = true\n";
const std::string kNone = "[corrections]\ntilt = false\n";

Errors5 tilting(double d) {
  return {2e-6 * d / 0.04, -3e-6 * d / 0.04, 1e-3 * d / 0.04, -0.6e-3 * std::sin(40 * d),
          0.8e-3 * d / 0.04};
}

// ε from the published coefficients. At 20 °C, ε - 1 is 537 ppm; it changes by -1.83 ppm/K, 5.3
// ppm/kPa and 2.03 ppm/%.
double expected_permittivity(double t_C, double p_kPa, double rh) {
  const double T = t_C + 273.15,
               e_kPa = rh / 100 * 0.61094 * std::exp(17.625 * t_C / (t_C + 243.04));
  return 1 + 2e-6 * (776 * p_kPa / T + 3.73e6 * e_kPa / (T * T));
}

// Reading of probe k for the errors `e`, calculated by hand with the angles between the probe and
// its target.
double shown_m(std::size_t k, const Errors5& e, double s_m, double factor, double ratio) {
  const double along = e[kEx], across = k < 3 ? e[kEy] : e[kEz];
  const double gap_m = kStandoff_m - s_m;
  const double theta2 = along * along + across * across;
  const double seen_m = gap_m - factor * kRadius_m * kRadius_m * theta2 / (4 * gap_m);
  return kStandoff_m - seen_m / ratio;
}

struct TrueConditions {
  std::vector<double> factor = std::vector<double>(5, 5.0);
  double ratio = expected_permittivity(23, 99, 65) / expected_permittivity(20, 101.325, 40);
};

SyntheticRun disturbed_run(const Rig& rig, const TrueConditions& nature) {
  SyntheticRun run{.rig = rig, .runs = 1};
  run.truth = tilting;
  run.added = [nature](std::size_t k, double d, double s_m, double) {
    return shown_m(k, tilting(d), s_m, nature.factor[k], nature.ratio) - s_m;
  };
  return run;
}

// The run after correction and solution, as in the pipeline.
Run corrected(const Rig& rig, Run run) {
  const Solver solver = Solver::create(rig, Model::rigid).value();
  const ReadingCorrection correction(rig, solver, {rig.physics->tilt, rig.physics->dielectric});
  for (MeasuredPoint& p : run.points) {
    const double d = rig.sides.target_travel_m(p.point.position_m);
    const auto out = correction.correct(d, p.point.probe_m, p.point.probe_u_m, {23, 99, 65});
    EXPECT_EQ(out.why_not, "");
    EXPECT_LT(out.rounds, 12);
    p.point.probe_m = out.readings_m;
    p.errors = restate(solver.solve(d, p.point.probe_m, p.point.probe_u_m), Model::rigid,
                       {rig.axis, {}}, d, kAtCarriage, kAtFixture);
  }
  return run;
}

// Errors of point j relative to the first point. An error that is common to all points is removed
// when the probes are zeroed.
Errors5 off(const Run& run, const Run& truth, std::size_t j) {
  Errors5 e{};
  for (std::size_t k = 0; k < 5; ++k)
    e[k] = (run.points[j].errors.local[k] - truth.points[j].errors.local[k]) -
           (run.points[0].errors.local[k] - truth.points[0].errors.local[k]);
  return e;
}

Errors5 worst(const Run& run, const Run& truth) {
  Errors5 most{};
  for (std::size_t j = 0; j < run.points.size(); ++j)
    for (std::size_t k = 0; k < 5; ++k)
      most[k] = std::max(most[k], std::abs(off(run, truth, j)[k]));
  return most;
}

Run true_run(const Rig& rig) {
  SyntheticRun run{.rig = rig, .runs = 1};
  run.truth = tilting;
  return run.measure();
}

TEST(ReadingCorrection, CorrectsKnownEffects) {
  const Rig rig = physics_rig(kBoth);
  const auto truth = true_run(rig), raw = disturbed_run(rig, TrueConditions()).measure();
  const Errors5 before = worst(raw, truth), after = worst(corrected(rig, raw), truth);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_GT(before[k], k < 2 ? 5e-9 : 1e-8) << k;
    EXPECT_LT(after[k], before[k] / 200) << k;
  }
  RecordProperty("before_nm", std::to_string(before[kDy] * 1e9));
  RecordProperty("after_nm", std::to_string(after[kDy] * 1e9));
}

TEST(ReadingCorrection, EachCorrectionHasItsSwitch) {
  const Rig tilt = physics_rig("[corrections]\ntilt = true\n");
  TrueConditions same_air;
  same_air.ratio = 1;
  const auto truth = true_run(tilt), raw = disturbed_run(tilt, same_air).measure();
  EXPECT_LT(worst(corrected(tilt, raw), truth)[kDz], worst(raw, truth)[kDz] / 200);
  const Rig air = physics_rig("[corrections]\ndielectric = true\n");
  TrueConditions square;
  square.factor.assign(5, 0.0);
  const auto in_air = disturbed_run(air, square).measure();
  const auto fine = corrected(air, in_air);
  // The correction for air is relative to the conditions of the calibration, so it also changes the
  // first point.
  for (std::size_t j = 0; j < truth.points.size(); ++j)
    EXPECT_NEAR(fine.points[j].errors.local[kDz], truth.points[j].errors.local[kDz], 1e-10);
  EXPECT_GT(std::abs(in_air.points[0].errors.local[kDz] - truth.points[0].errors.local[kDz]), 3e-9);
}

TEST(ReadingCorrection, ReportsClosedGapsAndTouchingElectrodes) {
  const Rig rig = physics_rig(kBoth);
  const Solver solver = Solver::create(rig, Model::rigid).value();
  const ReadingCorrection correction(rig, solver, {true, true});
  auto out = correction.correct(0, {0, 0, 0, 0, 260e-6}, {}, {20, 100, 50});
  EXPECT_NE(out.why_not.find("probe E"), std::string::npos) << out.why_not;
  EXPECT_NE(out.why_not.find("standoff_um"), std::string::npos);
  EXPECT_EQ(out.closed, 4U);
  EXPECT_TRUE(std::isnan(out.readings_m[4]));
  // A tilt of 21.5 mrad brings the edge of the electrode, at a radius of 2 mm, nearer by 43 µm. The
  // remaining gap is 35 µm.
  out = correction.correct(0, {215e-6, 0, 0, 0, 0}, {}, {20, 100, 50});
  EXPECT_NE(out.why_not.find("touch"), std::string::npos) << out.why_not;
}

TEST(ReadingCorrection, LostProbeGivesNoTilt) {
  const Rig rig = physics_rig(kBoth);
  const Solver solver = Solver::create(rig, Model::rigid).value();
  const ReadingCorrection correction(rig, solver, {true, true});
  const auto out = correction.correct(0, {kNaN, 1e-5, 0, 0, 0}, {}, {20, 101.325, 60});
  EXPECT_EQ(out.why_not, "");
  EXPECT_TRUE(std::isnan(out.readings_m[0]));
  EXPECT_NEAR(out.tilt_m[1], 0, 1e-18);
  EXPECT_NEAR(out.dielectric_m[1] * 1e9, -40.5e-6 * 240e3, 0.3) << "40 ppm of 240 µm, farther";
}

struct Inside {
  int count = 0, of = 0;
  double percent() const { return 100.0 * count / of; }
};

// Tilt factors, temperature, pressure and humidity are drawn at random. The errors at the last
// target are compared with the stated uncertainty.
TEST(ReadingCorrection, StatedUncertaintyCoversUnknownParameters) {
  std::string toml = physics_toml(kBoth);
  for (std::size_t at = 0; (at = toml.find("u_linearity_um = 0.002", at)) != std::string::npos;)
    toml.erase(at, 22);
  const Rig rig = parse_rig(toml, "rig.toml").value();
  const auto truth = true_run(rig);
  std::mt19937_64 source(7);
  std::normal_distribution<double> normal;
  std::array<Inside, 5> inside;
  for (int trial = 0; trial < 300; ++trial) {
    TrueConditions nature;
    for (double& factor : nature.factor) factor += 0.4 * normal(source);
    const double t = 23 + normal(source), p = 99 + 0.5 * normal(source),
                 rh = 65 + 5 * normal(source);
    nature.ratio = expected_permittivity(t, p, rh) / expected_permittivity(20, 101.325, 40);
    auto run = corrected(rig, disturbed_run(rig, nature).measure());
    const std::size_t last = 8;
    run.points.resize(last + 1);
    const ErrorsUncertainty u = run_uncertainty(rig, run).points[last];
    const Errors5 found = named_from_local(Axis::x, run.points[last].errors.local);
    const Errors5 right = named_from_local(Axis::x, truth.points[last].errors.local);
    for (std::size_t k = 0; k < 5; ++k) {
      ++inside[k].of;
      inside[k].count += std::abs(found[k] - right[k]) <= u.U[k];
    }
  }
  for (const Inside& of_error : inside) {
    EXPECT_GE(of_error.percent(), 92);
    EXPECT_LE(of_error.percent(), 98);
  }
}

TEST(ReadingCorrection, BudgetContainsUncorrectedEffects) {
  const Rig rig = physics_rig(kNone);
  const auto truth = true_run(rig), raw = disturbed_run(rig, TrueConditions()).measure();
  const auto stated = run_uncertainty(rig, raw);
  const auto without = run_uncertainty(test::rig_x(), raw);
  for (std::size_t j = 1; j < raw.points.size(); ++j)
    for (std::size_t k = 0; k < 5; ++k) {
      const double error = raw.points[j].errors.local[k] - truth.points[j].errors.local[k];
      const Errors5 u = local_from_named(Axis::x, stated.points[j].U);
      EXPECT_LE(std::abs(error), std::abs(u[k])) << j << ' ' << k;
    }
  EXPECT_TRUE(without.noise_only);
  EXPECT_FALSE(stated.noise_only);
}

}  // namespace
}  // namespace mdof::algo
