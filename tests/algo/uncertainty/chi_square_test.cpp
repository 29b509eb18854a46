// Tests χ² of the residuals for six and seven probes, with and without a probe that contradicts the
// others.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "algo/model/fixture.h"
#include "algo/model/rigid.h"
#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "algo/uncertainty/chi_square.h"
#include "tests/algo/rigs.h"
#include "tests/algo/stepping_log.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

struct Tested {
  std::vector<MeasuredPoint> points;
  std::optional<Notice> contradiction;
};

Tested measure(const SteppingLog& log, const FrameBlock& frames) {
  const auto solver = Solver::create(test::rig_x_redundant(log.probes), Model::rigid);
  EXPECT_TRUE(solver);
  DwellDetector detector({}, log.ids(), std::vector<double>(log.probes, 200e-6));
  std::vector<Point> found;
  detector.push(frames, found);
  detector.flush(found);
  const Residuals residuals(*solver, std::vector<double>(log.probes, 200e-6));
  Tested result{recognise_sequence(found, {}).points, {}};
  for (auto& p : result.points) {
    p.errors = solver->solve(p.point.position_m, p.point.probe_m, p.point.probe_u_m);
    residuals.test(p);
  }
  result.contradiction = residuals.contradiction(result.points);
  return result;
}

TEST(ChiSquare, LimitsMatchTheTables) {
  // Square of a quantile of the normal distribution.
  EXPECT_NEAR(chi_square_limit(1), 4.8916 * 4.8916, 1e-3);
  EXPECT_NEAR(chi_square_limit(2), -2 * std::log(1e-6), 1e-3);  // exponential distribution
  EXPECT_GT(chi_square_limit(12), chi_square_limit(11));
}

// Probability that χ² exceeds a value. It is e^-x/2 for two degrees of freedom and erfc(√(x/2)) for
// one; each two more degrees of freedom add a term (x/2)^a e^-x/2 / Γ(a + 1).
double exceeds(int freedom, double chi_square) {
  const double x = chi_square / 2;
  double a = freedom % 2 ? 0.5 : 1, q = freedom % 2 ? std::erfc(std::sqrt(x)) : std::exp(-x);
  for (; a < 0.5 * freedom; ++a) q += std::pow(x, a) * std::exp(-x) / std::tgamma(a + 1);
  return q;
}

TEST(ChiSquare, OneInAMillionExceedsEachLimit) {
  for (int freedom = 1; freedom <= 11; ++freedom)
    EXPECT_NEAR(exceeds(freedom, chi_square_limit(freedom)) * 1e6, 1, 1e-3) << freedom;
  for (int freedom = 12; freedom <= 60; ++freedom) {
    EXPECT_LT(exceeds(freedom, chi_square_limit(freedom)) * 1e6, 1) << freedom;
    EXPECT_LT(chi_square_limit(freedom) - chi_square_limit(freedom - 1), 2.2) << freedom;
  }
  EXPECT_EQ(chi_square_limit(0), chi_square_limit(1));
}

TEST(ChiSquare, ProbesThatAgreeAreNotFlagged) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SteppingLog log;
    log.seed = seed;
    log.probes = 6 + seed % 2;
    log.runs = 1;
    log.probe_step_um = seed % 3 == 0 ? 0.1 : 1e-6;
    const auto result = measure(log, log.frames());
    EXPECT_FALSE(result.contradiction) << seed;
    ASSERT_EQ(result.points.size(), 26u);
    for (const auto& p : result.points) EXPECT_TRUE(p.point.flags.empty()) << seed;
  }
}

// From the second run on, the reading of one probe is 0.5 µm too large. Each probe in turn has this
// fault.
TEST(ChiSquare, ReportsTheProbeThatContradictsTheOthers) {
  for (const std::size_t probes : {6u, 7u}) {
    for (std::size_t bad = 0; bad < probes; ++bad) {
      // With six probes, a fault of D or E is not detectable.
      if (probes == 6 && (bad == 3 || bad == 4)) continue;
      SteppingLog log;
      log.probes = probes;
      FrameBlock frames = log.frames();
      for (std::size_t i = frames.size() / 3; i < frames.size(); ++i)
        frames.probe_m[bad][i] += 0.5e-6;
      const auto result = measure(log, frames);
      ASSERT_TRUE(result.contradiction) << probes << " " << bad;
      EXPECT_EQ(result.contradiction->code, NoticeCode::probes_contradict);
      EXPECT_EQ(result.contradiction->subject, log.ids()[bad]);
      for (const auto& p : result.points)
        EXPECT_EQ(has_flag(p.point, Flag::residual), p.run > 1) << bad;
    }
  }
}

// Positions and scales of the probes differ from the rig by amounts that the rig declares.
struct DeclaredFaults {
  static constexpr double kShift_m = 0.1e-3, kScale = 1e-3;
  Rig rig = test::rig_x_redundant(7);

  DeclaredFaults() {
    for (Probe& probe : rig.probes) {
      probe.uncertainty.position.u = {kShift_m, kShift_m, kShift_m};
      probe.uncertainty.sensitivity.u = kScale;
    }
  }
  // `bad_m`: error of the reading of probe F at every second target.
  std::vector<MeasuredPoint> measure(std::uint64_t seed, const Rig* declares, double bad_m) const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Fixture fixture = make_fixture(rig).value();
    std::vector<double> scale;
    for (FixtureProbe& probe : fixture.probes) {
      const bool top = std::abs(probe.n_C.z()) > 0.5;
      probe.p_MP += kShift_m * Eigen::Vector3d(normal(random), top ? normal(random) : 0,
                                               top ? 0 : normal(random));
      scale.push_back(kScale * normal(random));
    }
    SyntheticRun synthetic{.rig = rig, .runs = 1, .stated = kAtCarriage, .fixture = fixture};
    synthetic.truth = [](double d) {
      return Errors5{1e-3 * d, -8e-4 * d, 2e-2 * d, 1e-2 * d, -2e-2 * d};
    };
    synthetic.added = [&](std::size_t k, double d, double reading_m, double) {
      const bool second = static_cast<int>(std::lround(d / 5e-3)) % 2 == 1;
      return scale[k] * reading_m + 5e-9 * normal(random) + (k == 5 && second ? bad_m : 0);
    };
    synthetic.u_reading_m = 5e-9;
    std::vector<MeasuredPoint> points = synthetic.measure().points;
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const std::vector<double> range_m(7, 200e-6);
    const Residuals residuals =
        declares ? Residuals(solver, range_m, *declares, points.front().point.begin_ns)
                 : Residuals(solver, range_m);
    for (MeasuredPoint& p : points) residuals.test(p);
    return points;
  }
};

std::size_t accused(const std::vector<MeasuredPoint>& points) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [](const auto& p) {
    return has_flag(p.point, Flag::residual);
  }));
}

// The covariance of the residuals contains the declared uncertainties. Runs with declared faults
// are not flagged, runs with larger faults are.
TEST(ChiSquare, DeclaredFaultsAreNotFlagged) {
  const DeclaredFaults faults;
  int without = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    EXPECT_EQ(accused(faults.measure(seed, &faults.rig, 0)), 0u) << seed;
    without += accused(faults.measure(seed, nullptr, 0)) > 0 ? 1 : 0;
    EXPECT_GE(accused(faults.measure(seed, &faults.rig, 5e-6)), 8u) << seed;
  }
  EXPECT_GT(without, 15);  // control: if the uncertainties are not declared, these runs are flagged
}

// χ² is the smallest weighted sum of the squares of the residuals, although the errors are solved
// with equal weights. The smallest sum is calculated here by the normal equations.
TEST(ChiSquare, IsThatOfTheBestErrors) {
  const DeclaredFaults faults;
  const Solver solver = Solver::create(faults.rig, Model::rigid).value();
  Eigen::VectorXd u(7);
  u << 5e-9, 20e-9, 5e-9, 60e-9, 10e-9, 5e-9, 30e-9;
  const Eigen::MatrixXd W = u.cwiseAbs2().cwiseInverse().asDiagonal();
  for (const MeasuredPoint& p : faults.measure(3, nullptr, 0)) {
    const double travel_m = p.point.position_m;
    const Agreement found = agreement(solver, travel_m, p.point.probe_m,
                                      u.cwiseAbs2().asDiagonal().toDenseMatrix(), p.errors);
    const Eigen::MatrixXd J = rigid_jacobian(solver.fixture(), travel_m, p.errors.local);
    const Eigen::VectorXd left = Eigen::Map<const Eigen::VectorXd>(p.point.probe_m.data(), 7) -
                                 rigid_readings(solver.fixture(), travel_m, p.errors.local);
    const Eigen::VectorXd best = (J.transpose() * W * J).ldlt().solve(J.transpose() * W * left);
    const Eigen::VectorXd rest = left - J * best;
    EXPECT_EQ(found.freedom, 2);
    EXPECT_NEAR(found.chi_square / rest.dot(W * rest), 1, 1e-3);
  }
}

// The notice contains the number of flagged points and the largest residual among them.
TEST(ChiSquare, NoticeHasTheLargestResidual) {
  const Rig rig = test::rig_x_redundant(7);
  const Solver solver = Solver::create(rig, Model::rigid).value();
  std::vector<MeasuredPoint> points = SyntheticRun{.rig = rig, .runs = 1}.measure().points;
  const Residuals residuals(solver, std::vector<double>(7, 200e-6));
  EXPECT_FALSE(residuals.contradiction(points));
  points[2].errors.residual_m = 3e-6;
  points[5].errors.residual_m = 2e-6;
  points[7].errors.residual_m = 9e-6;  // larger, but the point is not flagged
  for (const std::size_t j : {2u, 5u}) points[j].point.flags.push_back({Flag::residual});
  const auto found = residuals.contradiction(points);
  ASSERT_TRUE(found);
  EXPECT_EQ(test::number(*found, "residual_um"), 3);
  EXPECT_EQ(test::number(*found, "points"), 2);
  EXPECT_EQ(test::number(*found, "of"), 18);
}

// A probe is assumed to be linear to 1e-4 of its range with a rectangular distribution: for 200 µm
// this is 20 nm / √3. The reading of probe F may deviate until χ² reaches its limit for one degree
// of freedom.
TEST(ChiSquare, FlagsResidualsAboveNoiseAndLinearity) {
  const auto solver = Solver::create(test::rig_x_redundant(6), Model::rigid).value();
  const Residuals residuals(solver, std::vector<double>(6, 200e-6));
  const Eigen::VectorXd still = rigid_readings(solver.fixture(), 0, Errors5{});
  const double u = std::hypot(3e-9, 20e-9 / std::sqrt(3.0));
  // The part of a change of the reading of F that remains in the residuals. The six readings have
  // the same u.
  const Eigen::MatrixXd J = rigid_jacobian(solver.fixture(), 0, Errors5{});
  const Eigen::VectorXd left = Eigen::VectorXd::Unit(6, 5) - J * (J.transpose() * J).inverse() *
                                                                 J.transpose() *
                                                                 Eigen::VectorXd::Unit(6, 5);
  const double limit_m = u * std::sqrt(chi_square_limit(1)) / left.norm();
  for (const double part : {0.995, 1.005}) {
    MeasuredPoint p;
    p.point.probe_m.assign(still.data(), still.data() + 6);
    p.point.probe_m[5] += part * limit_m;
    p.point.probe_u_m.assign(6, 3e-9);
    p.errors = solver.solve(0, p.point.probe_m, p.point.probe_u_m);
    ASSERT_TRUE(p.errors.valid) << p.errors.reason;
    residuals.test(p);
    EXPECT_EQ(has_flag(p.point, Flag::residual), part > 1);
  }
}

// Any three of the four top probes determine the plane. If one top probe is wrong in every run, the
// residuals do not show which of the four it is.
TEST(ChiSquare, NamesNoProbeIfSeveralArePossible) {
  SteppingLog log;
  log.probes = 6;
  log.runs = 1;
  FrameBlock frames = log.frames();
  for (double& reading_m : frames.probe_m[1]) reading_m += 0.5e-6;
  const auto result = measure(log, frames);
  ASSERT_TRUE(result.contradiction);
  EXPECT_EQ(result.contradiction->subject, "");
  EXPECT_EQ(test::number(*result.contradiction, "points"), 26);
}

}  // namespace
}  // namespace mdof::algo
