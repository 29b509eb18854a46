// Simulated clampings with known mountings (tilted_target.h).
#include "algo/calibration/mounting.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "algo/model/solver.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "schema/units.h"
#include "tests/algo/calibration/tilted_target.h"

namespace mdof::algo {
namespace {

using test::TiltedTarget;

constexpr double kPlace_m = 50e-6, kUDirection_rad = 2e-3, kTilt_rad = 5e-3;
const std::string kDeclared = "u_position_mm = 0.05\nu_direction_mrad = 2\n";

Rig rig_with(const std::string& of_probes) {
  return parse_rig(test::mounting_rig_toml(of_probes), "rig_X.toml").value();
}

// True minus nominal values, in the order of MountingFit::change. The tangents of both planes are
// the local axes. A direction is stated by its components along the tangents.
Eigen::VectorXd true_deviations(const TiltedTarget& target, const Rig& rig) {
  Eigen::VectorXd truth(30);
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t across = k < 3 ? 1 : 2, facing = k < 3 ? 2 : 1;
    const auto& p = target.probes[k];
    const auto i = static_cast<Eigen::Index>(6 * k);
    truth(i) = p.place[0] - rig.probes[k].position_m[0];
    truth(i + 1) = p.place[across] - rig.probes[k].position_m[across];
    truth(i + 2) = p.zero;
    truth(i + 3) = p.way[0] / p.way[facing];
    truth(i + 4) = p.way[across] / p.way[facing];
    truth(i + 5) = p.scale - 1;
  }
  return truth;
}

TEST(Mounting, ExactReadingsGiveRelativePositions) {
  std::mt19937_64 rng(1);
  TiltedTarget target(rng, kPlace_m, 0, 3e-6);
  target.noise_m = 0;
  target.clamp(4, kTilt_rad, rng);
  const Rig rig = rig_with("");
  const auto fit = fit_mounting(rig, target.logs(rng));
  ASSERT_TRUE(fit) << fit.error().message;
  const Eigen::VectorXd truth = true_deviations(target, rig);
  const Eigen::VectorXd part = fit->seen * truth;
  // Position of each probe relative to the first probe of its plane.
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {3, 4}})
    for (int j = 0; j < 3; ++j) {
      const double found = fit->change(6 * a + j) - fit->change(6 * b + j);
      EXPECT_NEAR(found, truth(6 * a + j) - truth(6 * b + j), j == 2 ? 1e-10 : 1e-8);
      EXPECT_NEAR(fit->change(6 * a + j), part(6 * a + j), j == 2 ? 1e-10 : 1e-8);
    }
  EXPECT_TRUE(fit->found.explained);
  EXPECT_LT(fit->found.chi_square, 1);
}

// χ² may differ from the degrees of freedom by at most five of its standard deviations. The result
// must name the combinations that the clampings do not determine.
TEST(Mounting, NoisyReadingsGiveTheExpectedUncertainties) {
  std::mt19937_64 rng(2);
  TiltedTarget target(rng, kPlace_m, kUDirection_rad, 3e-6);
  target.clamp(6, kTilt_rad, rng);
  const Rig rig = rig_with(kDeclared);
  const auto fit = fit_mounting(rig, target.logs(rng));
  ASSERT_TRUE(fit) << fit.error().message;
  const auto& found = fit->found;
  const double freedom = found.freedom;
  EXPECT_NEAR(found.chi_square, freedom, 5 * std::sqrt(2 * freedom));
  EXPECT_EQ(found.clampings, 6u);
  for (const MountedProbe& probe : found.probes) {
    EXPECT_TRUE(probe.position_seen);
    EXPECT_FALSE(probe.direction_seen) << "and the rig's stays";
    EXPECT_NEAR(probe.u_direction_rad, kUDirection_rad, 1e-4);
    for (const double u : probe.u_position_m) EXPECT_LT(u, 2.5e-6);
  }
  for (const char* says :
       {"position of A, B, C along X", "position of A, B, C along Y", "position of D, E along X",
        "position of D, E along Z", "the common zero offset of A, B, C",
        "the common zero offset of D, E", "the direction of A", "the direction of E",
        "the squareness of the axes of the traverses"})
    EXPECT_TRUE(std::any_of(found.not_seen.begin(), found.not_seen.end(), [&](const auto& line) {
      return line.find(says) != std::string::npos;
    })) << says;
  // u of the mean of two or three independent positions, each with u = 50 um.
  EXPECT_NEAR(found.u_together_m[0], kPlace_m / std::sqrt(2), 1e-9);
  EXPECT_NEAR(found.u_together_m[1], kPlace_m / std::sqrt(3), 1e-9);
  EXPECT_NEAR(found.u_together_m[2], kPlace_m / std::sqrt(2), 1e-9);
}

// 500 calibrations; the mounting, the tilts and the noise are drawn anew in each. 94 to 96.5 % of
// the 95 % intervals must contain the truth. This is tested for the determined part alone. It is
// also tested for all positions with the declared uncertainty of the rig added.
TEST(Mounting, IntervalsCoverTheTruth) {
  std::mt19937_64 rng(3);
  const Rig rig = rig_with(kDeclared);
  int inside = 0, all_inside = 0, n = 0;
  double distance = 0;
  for (int trial = 0; trial < 500; ++trial) {
    TiltedTarget target(rng, kPlace_m, kUDirection_rad, 3e-6);
    target.clamp(4, kTilt_rad, rng);
    const auto fit = fit_mounting(rig, target.logs(rng));
    ASSERT_TRUE(fit) << fit.error().message;
    const Eigen::VectorXd truth = true_deviations(target, rig);
    const Eigen::VectorXd off = fit->change - fit->seen * truth;
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 3; ++j) {
        const int i = 6 * k + j;
        inside += std::abs(off(i)) <= 1.96 * std::sqrt(fit->covariance(i, i));
        if (j == 2) continue;
        ++n;
        const double unseen = kPlace_m * kPlace_m / (k < 3 ? 3 : 2);
        all_inside +=
            std::abs(fit->change(i) - truth(i)) <= 1.96 * std::sqrt(fit->covariance(i, i) + unseen);
      }
    const double ab = off(0) - off(6);
    distance +=
        ab * ab / (fit->covariance(0, 0) + fit->covariance(6, 6) - 2 * fit->covariance(0, 6));
  }
  std::printf("inside %.2f %% of %d, with the rig's %.2f %% of %d\n", 100.0 * inside / (n * 1.5),
              n * 3 / 2, 100.0 * all_inside / n, n);
  EXPECT_NEAR(inside / (n * 1.5), 0.9525, 0.0125);
  EXPECT_NEAR(all_inside / static_cast<double>(n), 0.9525, 0.0125);
  EXPECT_NEAR(distance / 500, 1, 0.2) << "the correlations too";
}

// The scale of a probe is an unknown if the rig declares its uncertainty. If it were not an
// unknown, a scale error would appear as a position error of ten micrometres.
TEST(Mounting, DeclaredSensitivityUKeepsPositionsCorrect) {
  std::mt19937_64 rng(4);
  TiltedTarget target(rng, kPlace_m, 0, 3e-6);
  target.probes[0].scale = 1.001;
  target.probes[1].scale = 0.999;
  target.noise_m = 1e-9;
  target.clamp(6, kTilt_rad, rng);
  const auto logs = target.logs(rng);
  const Rig exact = rig_with(kDeclared),
            unsure = rig_with(kDeclared + "u_sensitivity_ppm = 1000\n");
  const auto worst = [&](const Rig& rig) {
    const auto fit = fit_mounting(rig, logs);
    if (!fit) return 1.0;
    const Eigen::VectorXd off = fit->change - true_deviations(target, rig);
    return std::max(std::abs(off(0) - off(6)), std::abs(off(7) - off(13)));
  };
  EXPECT_GT(worst(exact), 5e-6);
  EXPECT_LT(worst(unsure), 1e-6);
  const auto fit = fit_mounting(unsure, logs).value();
  for (std::size_t k = 0; k < fit.found.probes.size(); ++k)
    EXPECT_EQ(fit.found.probes[k].scale_1, fit.change(static_cast<Eigen::Index>(6 * k + 5))) << k;
}

TEST(Mounting, UnexplainedResidualsIncreaseU) {
  std::mt19937_64 rng(5);
  TiltedTarget target(rng, kPlace_m, 0, 3e-6);
  target.clamp(4, kTilt_rad, rng);
  auto logs = target.logs(rng);
  const Rig rig = rig_with(kDeclared);
  const auto right = fit_mounting(rig, logs).value();
  for (auto& clamping : logs)
    for (auto& traverse : clamping.traverses)
      for (auto& stop : traverse.stops)
        for (double& u : stop.u_reading_m) u /= 5;
  const auto stated = fit_mounting(rig, logs).value();
  EXPECT_TRUE(right.found.explained);
  EXPECT_FALSE(stated.found.explained);
  EXPECT_NEAR(stated.covariance(0, 0) / right.covariance(0, 0), 1, 0.3);
}

// One probe has a scale error of 1 % that the rig does not declare. Its effect is about 0.1 um; the
// noise is 1 nm.
TEST(Mounting, RefusesALargeMisfit) {
  const auto refused = [](double scale, double noise_m, const std::string& declared) {
    std::mt19937_64 rng(8);
    TiltedTarget target(rng, kPlace_m, 0, 3e-6);
    target.probes[0].scale = scale;
    target.noise_m = noise_m;
    target.clamp(6, kTilt_rad, rng);
    const auto fit = fit_mounting(rig_with(kDeclared + declared), target.logs(rng));
    return fit ? Remedy::none : fit.error().remedy;
  };
  EXPECT_EQ(refused(1.01, 1e-9, ""), Remedy::calibrate_sensitivity);
  EXPECT_EQ(refused(1.01, 1e-9, "u_sensitivity_ppm = 10000\n"), Remedy::none);
  EXPECT_EQ(refused(1.0001, 1e-9, ""), Remedy::none) << "widened";
}

TEST(Mounting, RefusesTooFewTilts) {
  std::mt19937_64 rng(6);
  TiltedTarget target(rng, kPlace_m, 0, 3e-6);
  target.clamp(1, kTilt_rad, rng);
  const Rig rig = rig_with(kDeclared);
  const auto once = fit_mounting(rig, target.logs(rng));
  ASSERT_FALSE(once);
  EXPECT_EQ(once.error().code, ErrorCode::check);
  EXPECT_NE(once.error().message.find("Clamp the target at three"), std::string::npos);
  // Two tilts determine the position of each probe along one direction only.
  target.clamp(2, kTilt_rad, rng);
  target.clampings.erase(target.clampings.begin());
  const auto twice = fit_mounting(rig, target.logs(rng));
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find("do not determine the position of any probe"),
            std::string::npos);
}

TEST(Mounting, DetectsAReversedAxis) {
  std::mt19937_64 rng(7);
  TiltedTarget target(rng, kPlace_m, 0, 3e-6);
  target.clamp(4, kTilt_rad, rng);
  auto logs = target.logs(rng);
  for (auto& clamping : logs)
    for (auto& stop : clamping.traverses[1].stops) stop.travel_m = -stop.travel_m;
  const auto fit = fit_mounting(rig_with(kDeclared), logs);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().remedy, Remedy::reverse_target) << fit.error().message;
}

// Errors that the mounting causes in a measurement, before and after the calibration. The true
// probes measure random errors of the axis (simulation II: 1 mrad, 50 um). The readings are solved
// with the declared rig and with the calibrated rig. The reference point of straightness is the
// origin of the calibrated rig, see the README.
TEST(Mounting, CalibrationReducesInducedErrorsTwentyfold) {
  std::mt19937_64 rng(8);
  const Rig rig = rig_with(kDeclared);
  std::uniform_real_distribution<> angle(-1e-3, 1e-3), shift(-50e-6, 50e-6), travel(0, 0.01);
  std::array<double, 5> before{}, after{};
  for (int machine = 0; machine < 40; ++machine) {
    TiltedTarget target(rng, kPlace_m, kUDirection_rad, 3e-6);
    target.clamp(6, kTilt_rad, rng);
    const auto fit = fit_mounting(rig, target.logs(rng)).value();
    Rig calibrated = rig;
    for (std::size_t k = 0; k < 5; ++k)
      calibrated.probes[k].position_m = fit.found.probes[k].position_m;
    const auto declared = Solver::create(rig, Model::rigid).value();
    const auto known = Solver::create(calibrated, Model::rigid).value();
    // True deviations that the clampings do not determine, such as a common shift of the probes.
    // They move the reference point of straightness.
    const Eigen::VectorXd off =
        true_deviations(target, rig) - fit.seen * true_deviations(target, rig);
    for (int trial = 0; trial < 200; ++trial) {
      const test::TrueClamping e{{angle(rng), angle(rng), angle(rng)}, {0, shift(rng), shift(rng)}};
      const double d = travel(rng);
      std::vector<double> now;
      for (const auto& p : target.probes)
        now.push_back(test::reading(p, e, {d, 0, 0}) - test::reading(p, {}, {0, 0, 0}));
      const std::vector<double> u(5, 10e-9);
      const auto a = declared.solve(d, now, u), b = known.solve(d, now, u);
      ASSERT_TRUE(a.valid && b.valid);
      Errors5 truth = {e.offset[1], e.offset[2], e.angle[0], e.angle[1], e.angle[2]};
      for (std::size_t i = 0; i < 5; ++i)
        before[i] += (a.local[i] - truth[i]) * (a.local[i] - truth[i]);
      truth[kDy] += e.angle[2] * off(18) - e.angle[0] * off(19);
      truth[kDz] += e.angle[0] * off(1) - e.angle[1] * off(0);
      for (std::size_t i = 0; i < 5; ++i)
        after[i] += (b.local[i] - truth[i]) * (b.local[i] - truth[i]);
    }
  }
  const char* names[] = {"dy/nm", "dz/nm", "ex/nrad", "ey/nrad", "ez/nrad"};
  for (std::size_t i = 0; i < 5; ++i) {
    const double was = std::sqrt(before[i] / 8000), is = std::sqrt(after[i] / 8000);
    std::printf("%-8s before %8.1f after %7.2f ratio %.1f\n", names[i], was * 1e9, is * 1e9,
                was / is);
    EXPECT_GT(was / is, 20) << names[i];
  }
}

CalibrationRecord record_of(const MountingFit& fit, const Rig& rig, bool with_covariance) {
  CalibrationRecord record;
  record.kind = "mounting";
  record.rig = rig.name;
  record.date = "2026-11-02";
  record.valid_until = "2027-11-02";
  if (with_covariance) record.covariance = fit.found.covariance;
  for (const MountedProbe& found : fit.found.probes) {
    CalibratedProbe& probe = record.probes.emplace_back();
    probe.id = found.id;
    if (found.position_seen) probe.position_m = found.position_m;
    probe.u_position_m = found.u_position_m;
    probe.offset_um = to_um(found.zero_m);
    probe.u_offset_m = found.u_zero_m;
  }
  return record;
}

// Measures angles of a target that is tilted by some mrad; the calibrated rig is read from its
// record. Returns the share (%) of 300 intervals that contain the truth, in the order of Errors5.
std::array<double, 5> angle_coverage(bool with_covariance) {
  std::mt19937_64 rng(11);
  const std::string text = test::mounting_rig_toml(kDeclared);
  const Rig rig = parse_rig(text, "rig_X.toml").value();
  std::uniform_real_distribution<> angle(-3e-3, 3e-3);
  std::array<double, 5> held{};
  constexpr int kMachines = 300;
  for (int machine = 0; machine < kMachines; ++machine) {
    TiltedTarget target(rng, kPlace_m, 0, 3e-6);
    target.noise_m = 20e-9;
    target.clamp(4, kTilt_rad, rng);
    const auto fit = fit_mounting(rig, target.logs(rng)).value();
    const std::string record = record_text(record_of(fit, rig, with_covariance));
    Rig calibrated =
        parse_rig("calibration = \"m.toml\"\n" + text + record.substr(record.find(kRecordHead)),
                  "rig_X.toml")
            .value();
    for (Probe& probe : calibrated.probes) probe.uncertainty.direction = {};
    const test::TrueClamping e{{angle(rng), angle(rng), angle(rng)}, {0, 0, 0}};
    const double d = 0.005;
    mdof::Run run;
    run.header.stated = kAtCarriage;
    run.header.provenance.model = to_string(Model::rigid);
    MeasuredPoint& point = run.points.emplace_back();
    point.point.position_m = d;
    for (std::size_t k = 0; k < target.probes.size(); ++k)
      point.point.probe_m.push_back(test::reading(target.probes[k], e, {d, 0, 0}) -
                                    fit.found.probes[k].zero_m);
    point.point.probe_u_m.assign(5, 0);
    point.errors = Solver::create(calibrated, Model::rigid)
                       .value()
                       .solve(d, point.point.probe_m, point.point.probe_u_m);
    const Errors5 u = run_uncertainty(calibrated, run).points[0].u;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const std::size_t local = error_names(Axis::x)[k].local;
      if (local < kEx) continue;
      const double off = point.errors.local[local] - e.angle[local - kEx];
      held[local] += (std::abs(off) <= 1.96 * u[k]) * 100.0 / kMachines;
    }
  }
  return held;
}

// The zeros and positions that one calibration determines are correlated. Their effects partly
// cancel.
TEST(Mounting, RecordKeepsCovariancesForTheBudget) {
  const auto with = angle_coverage(true), without = angle_coverage(false);
  for (const std::size_t e : {kEx, kEy, kEz}) {
    std::printf("held %.1f %%, without covariances %.1f %%\n", with[e], without[e]);
    EXPECT_GT(with[e], 91.2) << e;  // 95 % less three standard deviations of 300 trials
  }
  EXPECT_LT(without[kEz], 85);
}

// Large tilts and probes with a long range also determine directions. The test calculates, over 80
// calibrations, the squared distance between determined and true directions. The matrix of the
// record normalises this distance.
TEST(Mounting, MatrixContainsTheDeterminedDirections) {
  std::mt19937_64 rng(21);
  const Rig rig = parse_rig(test::mounting_rig_toml(kDeclared, 4000), "rig_X.toml").value();
  double distance = 0, strongest = 0;
  int seen = 0;
  for (int trial = 0; trial < 80; ++trial) {
    TiltedTarget target(rng, kPlace_m, kUDirection_rad, 3e-6);
    target.noise_m = 1e-9;
    target.range_m = 4e-3;
    target.clamp(6, 0.06, rng);
    const auto fit = fit_mounting(rig, target.logs(rng));
    ASSERT_TRUE(fit) << fit.error().message;
    const CalibrationCovariance& matrix = fit->found.covariance;
    std::vector<Eigen::Index> at;
    std::vector<double> off;
    for (std::size_t k = 0; k < 5; ++k)
      for (const std::size_t axis : {std::size_t{0}, std::size_t{k < 3 ? 1U : 2U}}) {
        const auto& probe = fit->found.probes[k];
        const auto name =
            std::find(matrix.of.begin(), matrix.of.end(), direction_name(probe.id, axis));
        EXPECT_EQ(name != matrix.of.end(), probe.direction_seen);
        if (name == matrix.of.end()) continue;
        at.push_back(name - matrix.of.begin());
        off.push_back(probe.direction[axis] - target.probes[k].way[axis]);
      }
    const auto n = static_cast<Eigen::Index>(at.size());
    Eigen::MatrixXd of(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto row = static_cast<std::size_t>(at[static_cast<std::size_t>(i)]);
        of(i, j) = matrix.m2[row][static_cast<std::size_t>(at[static_cast<std::size_t>(j)])];
      }
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        strongest = std::max(strongest, std::abs(of(i, j)) / std::sqrt(of(i, i) * of(j, j)));
    const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(off.data(), n);
    distance += v.dot(of.ldlt().solve(v));
    seen += static_cast<int>(n);
  }
  std::printf("distance %.3f of %d directions, correlations to %.2f\n", distance / seen, seen,
              strongest);
  ASSERT_GT(seen, 400);
  EXPECT_NEAR(distance / seen, 1, 0.2);
  EXPECT_GT(strongest, 0.3);
  EXPECT_LT(strongest, 1);
}

}  // namespace
}  // namespace mdof::algo
