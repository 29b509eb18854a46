// Do the stated 95 % intervals hold the truth? Runs on fixtures whose every declared contributor
// was drawn from its distribution. The faults are made here, by other code than the budget's:
// probes moved and turned in the fixture itself, flatness by waves of any direction.
// MDOF_COVERAGE_RUNS=2000 for figures worth quoting.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <map>
#include <random>

#include "algo/uncertainty/budget.h"
#include "schema/base/random.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr const char* kDeclared =
    "u_calibration_um = 0.05\nu_sensitivity_ppm = 1500\nu_position_mm = [0.08, 0.08, 0.08]\n"
    "u_direction_mrad = 2\n";
constexpr const char* kRest =
    "[installation]\nu_angle_mrad = [2, 2, 2]\nu_offset_mm = [0.05, 0.05, 0.05]\n"
    "[drift]\nu_um_per_h = 0.2\n"
    "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = 0.02\n"
    "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.02\n";

Rig declared_rig(double l_mm, double h_mm, double z_mm) {
  std::string toml = test::rig_x_toml(l_mm, h_mm, z_mm);
  for (std::size_t at = 0; (at = toml.find("measures", at)) != std::string::npos; at += 20) {
    toml.insert(at, kDeclared);
    at += std::string(kDeclared).size();
  }
  return parse_rig(toml + kRest, "rig_X.toml").value();
}

class Faults {
 public:
  Faults(const Rig& rig, std::uint64_t seed) : rig_(rig), engine_(seed) {}

  double normal() { return normal_(engine_); }
  Eigen::Vector3d vector(double u) { return {u * normal(), u * normal(), u * normal()}; }

  Fixture fixture() {
    Fixture as_is = make_fixture(rig_).value();
    const RigUncertainty& whole = rig_.uncertainty;
    const Eigen::Vector3d turn = vector(whole.installation_angle.u[0]);
    const Eigen::Vector3d shift = vector(whole.installation_offset.u[0]);
    for (std::size_t k = 0; k < as_is.probes.size(); ++k) {
      FixtureProbe& probe = as_is.probes[k];
      const ProbeUncertainty& u = rig_.probes[k].uncertainty;
      probe.p_MP += vector(u.position.u[0]);
      const Eigen::Vector3d tilt = vector(u.direction.u);
      probe.u_M = (probe.u_M + tilt.cross(probe.u_M)).normalized();
      const Eigen::AngleAxisd all(turn.norm(), turn.normalized());
      probe.p_MP = all * probe.p_MP + shift;
      probe.u_M = all * probe.u_M;
    }
    return as_is;
  }

  // Four waves a plane, amplitudes as 1/k², made to have the declared u.
  struct Wave {
    double amplitude_m, along, across, per_m, phase;
  };
  std::vector<Wave> waves(const TargetPlane& plane) {
    std::vector<Wave> all;
    const double norm = std::sqrt(1 + 1 / 16.0 + 1 / 81.0 + 1 / 256.0);
    for (int w = 1; w <= 4; ++w) {
      const double direction = 2 * M_PI * uniform_(engine_);
      all.push_back({plane.u_flatness.u * std::sqrt(2.0) / (w * w) / norm, std::cos(direction),
                     std::sin(direction), w / plane.flatness_length_m,
                     2 * M_PI * uniform_(engine_)});
    }
    return all;
  }

 private:
  const Rig& rig_;
  std::mt19937_64 engine_;
  std::normal_distribution<> normal_;
  std::uniform_real_distribution<> uniform_;
};

double height(const std::vector<Faults::Wave>& waves, double first, double second) {
  double sum = 0;
  for (const auto& w : waves)
    sum += w.amplitude_m *
           std::sin(2 * M_PI * (first * w.along + second * w.across) * w.per_m + w.phase);
  return sum;
}

Errors5 true_errors(double d) {
  return {1.5e-6 * std::sin(90 * d) + 8e-6 * d, 1e-6 * std::cos(110 * d) - 5e-4 * d,
          40e-6 * std::sin(60 * d), 60e-6 * std::cos(50 * d), 80e-6 * std::sin(70 * d)};
}

struct Tally {
  int inside = 0, all = 0;
  double percent() const { return 100.0 * inside / all; }
};
using Coverage = std::map<std::string, Tally>;

void count(Coverage& coverage, const Budget& budget, double truth) {
  Tally& tally = coverage[budget.figure];
  ++tally.all;
  tally.inside += std::abs(budget.value - truth) <= budget.U;
}

int wanted_runs() {
  const char* wanted = std::getenv("MDOF_COVERAGE_RUNS");
  return wanted ? std::atoi(wanted) : 0;
}

// Without the environment those whose U needs no Monte Carlo: a tenth of the time.
std::vector<Figure> figures() {
  std::vector<Figure> all = errors_at_target(Axis::x, 8);
  for (const Figure& figure : figures_of_run(Axis::x))
    if (!figure.is_range || wanted_runs() > 0) all.push_back(figure);
  return all;
}

Coverage coverage_of(const Rig& declared, const Rig& faulty, int trials) {
  Coverage coverage;
  constexpr double kNoise_m = 8e-9;
  for (int t = 0; t < trials; ++t) {
    Faults faults(faulty, 1000 + static_cast<std::uint64_t>(t));
    SyntheticRun synthetic{.rig = declared, .model = Model::exact, .runs = 5};
    synthetic.truth = true_errors;
    synthetic.u_reading_m = kNoise_m;
    const Fixture nominal = make_fixture(declared).value();
    synthetic.fixture = faults.fixture();
    std::vector<double> zero, gain, drift;
    for (const Probe& probe : faulty.probes) {
      zero.push_back(probe.uncertainty.calibration.u * faults.normal());
      gain.push_back(probe.uncertainty.sensitivity.u * faults.normal());
      drift.push_back(faulty.uncertainty.drift.u * faults.normal());
    }
    std::vector<std::vector<Faults::Wave>> planes;
    for (const TargetPlane& plane : faulty.planes) planes.push_back(faults.waves(plane));
    synthetic.added = [&](std::size_t k, double d, double reading_m, double time_s) {
      const FixtureProbe& probe = nominal.probes[k];
      const double second = *probe.plane == 0 ? probe.p_MP.y() : probe.p_MP.z();
      return zero[k] + gain[k] * reading_m + drift[k] * time_s + kNoise_m * faults.normal() +
             height(planes[*probe.plane], probe.p_MP.x() - d, second);
    };
    const auto run = synthetic.measure();
    const auto budgets = RunBudgets::create(declared, run).value();
    SyntheticRun without{.rig = declared, .model = Model::exact, .runs = 1};
    without.truth = true_errors;
    const auto truth = RunBudgets::create(test::rig_x(), without.measure()).value();
    for (const Figure& figure : figures())
      count(coverage, budgets.of(figure), figure.of(truth.means()));
  }
  return coverage;
}

TEST(CoverageOfRuns, StatedIntervalsHoldTheTruth) {
  const int runs = wanted_runs() > 0 ? wanted_runs() : 150;
  const double three_sd = 65 / std::sqrt(runs);  // of the share of so many trials, in %
  for (const auto& [l_mm, h_mm, z_mm] :
       {std::array{10.0, 15.0, 20.0}, std::array{25.0, 8.0, 12.0}}) {
    const Rig rig = declared_rig(l_mm, h_mm, z_mm);
    for (const auto& [figure, tally] : coverage_of(rig, rig, runs)) {
      std::printf("l %2.0f mm %-22s %5.1f %%\n", l_mm, figure.c_str(), tally.percent());
      EXPECT_GT(tally.percent(), 95 - three_sd) << figure;
    }
  }
}

// The control: faults that the rig does not declare are not covered.
TEST(CoverageOfRuns, WhatIsNotDeclaredIsMissed) {
  const Rig faulty = declared_rig(10, 15, 20);
  Rig declared = faulty;
  for (Probe& probe : declared.probes) probe.uncertainty.calibration.u = 0;
  const Coverage coverage = coverage_of(declared, faulty, 150);
  EXPECT_LT(coverage.at("EYX_um").percent(), 88);
}

}  // namespace
}  // namespace mdof::algo
