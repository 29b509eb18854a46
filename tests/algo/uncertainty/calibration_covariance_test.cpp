// The effect of the covariance matrix of a calibration record on the errors, compared with J Σ Jᵀ.
// Each derivative in J comes from fixtures in which one quantity is displaced, and from the rigid
// model's readings.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "algo/uncertainty/run_uncertainty.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

struct Quantity {
  std::string name;
  double u;
  std::size_t probe;
  int kind;  // 0: place, 1: direction, 2: zero
  Eigen::Index axis;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"B.x", 4e-6, 1, 0, 0},    {"B.y", 7e-6, 1, 0, 1},    {"B.zero", 3e-8, 1, 2, 0},
      {"B.nx", 1.5e-3, 1, 1, 0}, {"B.ny", 2.5e-3, 1, 1, 1}, {"E.x", 5e-6, 4, 0, 0},
      {"E.zero", 2e-8, 4, 2, 0}, {"E.nx", 2e-3, 4, 1, 0},   {"E.nz", 1e-3, 4, 1, 2}};
  return all;
}

Eigen::MatrixXd matrix() {
  std::mt19937_64 engine(5);
  std::normal_distribution<> normal;
  const auto n = static_cast<Eigen::Index>(quantities().size());
  Eigen::MatrixXd root(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) root(i, j) = normal(engine);
  Eigen::MatrixXd m = root * root.transpose();
  const Eigen::VectorXd scale = m.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      m(i, j) *= quantities()[static_cast<std::size_t>(i)].u *
                 quantities()[static_cast<std::size_t>(j)].u / (scale(i) * scale(j));
  return m;
}

Rig rig_with(const Eigen::MatrixXd& m) {
  CalibrationRecord record;
  record.kind = "mounting";
  record.rig = "test";
  record.date = "2026-11-02";
  record.valid_until = "2027-11-02";
  const Rig plain = test::rig_x();
  for (const Probe& nominal : plain.probes) {
    CalibratedProbe& probe = record.probes.emplace_back();
    probe.id = nominal.id;
    if (nominal.id != "B" && nominal.id != "E") continue;
    probe.position_m = nominal.position_m;
    probe.direction = nominal.direction;
    probe.u_direction_rad = 2e-3;
    probe.offset_um = 0;
  }
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    record.covariance.of.push_back(quantities()[static_cast<std::size_t>(i)].name);
    auto& row = record.covariance.m2.emplace_back();
    for (Eigen::Index j = 0; j < m.cols(); ++j) row.push_back((m(i, j) + m(j, i)) / 2);
  }
  const std::string text = record_text(record);
  auto rig = parse_rig(
      "calibration = \"m.toml\"\n" + test::rig_x_toml() + text.substr(text.find(kRecordHead)),
      "rig.toml");
  EXPECT_TRUE(rig) << rig.error().message;
  return *rig;
}

Errors5 truth(double d) {
  return {2e-4 * std::sin(70 * d), 150e-6 + 1e-4 * std::cos(90 * d), 15e-3 * std::sin(60 * d),
          -12e-3 + 0.2 * d, 20e-3 * std::cos(40 * d)};
}

// Run of a fixture in which one quantity is changed by `by`.
Run displaced(const Rig& rig, const Quantity& q, double by) {
  SyntheticRun synthetic{.rig = rig, .runs = 1, .stated = kAtCarriage, .truth = truth};
  synthetic.fixture = make_fixture(rig).value();
  FixtureProbe& probe = synthetic.fixture->probes[q.probe];
  if (q.kind == 0) probe.p_MP(q.axis) += by;
  if (q.kind == 1) {
    probe.u_M(q.axis) += by;
    probe.u_M.normalize();
  }
  if (q.kind == 2)
    synthetic.added = [&](std::size_t k, double, double, double) {
      return k == q.probe ? by : 0.0;
    };
  return synthetic.measure();
}

TEST(CalibrationCovariance, PlacesDirectionsAndZerosAffectEachError) {
  const Eigen::MatrixXd m = matrix();
  const Rig rig = rig_with(m);
  const mdof::Run run =
      SyntheticRun{.rig = rig, .runs = 1, .stated = kAtCarriage, .truth = truth}.measure();
  std::vector<mdof::Run> plus, minus;
  for (const Quantity& q : quantities()) {
    plus.push_back(displaced(rig, q, q.u));
    minus.push_back(displaced(rig, q, -q.u));
  }
  const RunUncertainty stated = run_uncertainty(rig, run);
  EXPECT_EQ(stated.why, "");
  double by_directions = 0;
  for (std::size_t j = 0; j < run.points.size(); ++j)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const std::size_t e = error_names(Axis::x)[k].local;
      Eigen::VectorXd by(m.rows());
      for (Eigen::Index i = 0; i < m.rows(); ++i) {
        const auto q = static_cast<std::size_t>(i);
        by(i) = (plus[q].points[j].errors.local[e] - minus[q].points[j].errors.local[e]) /
                (2 * quantities()[q].u);
      }
      const double variance = by.dot(m * by);
      EXPECT_NEAR(stated.points[j].u[k] / std::sqrt(variance), 1, 2e-3) << j << " " << k;
      Eigen::VectorXd without = by;
      for (Eigen::Index i = 0; i < m.rows(); ++i)
        if (quantities()[static_cast<std::size_t>(i)].kind == 1) without(i) = 0;
      by_directions = std::max(by_directions, std::abs(1 - without.dot(m * without) / variance));
    }
  EXPECT_GT(by_directions, 0.02) << "the directions count here";
  const auto lines = contributors(rig, run).value();
  ASSERT_EQ(lines.size(), 1u) << "no direction counts a second time";
}

}  // namespace
}  // namespace mdof::algo
