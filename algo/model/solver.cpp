#include "algo/model/solver.h"

#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"
#include "algo/model/rigid.h"

namespace mdof::algo {
namespace {

std::vector<bool> usable(const std::vector<double>& readings_m) {
  std::vector<bool> use(readings_m.size());
  for (std::size_t i = 0; i < use.size(); ++i) use[i] = std::isfinite(readings_m[i]);
  return use;
}

// Returns the weights of the probes; 0 for a lost probe. With more than five probes, all weights
// are equal: with weights from the noise of a stop, the constant zero of a redundant probe would
// have another effect at each stop, and would look like an error of the axis. With five probes,
// weights change the rounding only. They are 1/u² if all u are known, so that old recordings keep
// their bits.
std::vector<double> make_weights(const std::vector<bool>& use, const std::vector<double>& u_m) {
  bool known = u_m.size() == use.size() && std::count(use.begin(), use.end(), true) == kErrorCount;
  for (std::size_t i = 0; known && i < use.size(); ++i) known = !use[i] || u_m[i] > 0;
  std::vector<double> weights(use.size());
  for (std::size_t i = 0; i < use.size(); ++i) {
    weights[i] = !use[i] ? 0.0 : known ? 1 / (u_m[i] * u_m[i]) : 1.0;
  }
  return weights;
}

AxisErrors not_seen(const Fixture& fixture, const std::vector<bool>& use, const Visibility& seen) {
  AxisErrors errors;
  errors.reason = describe_unseen(fixture, use, seen);
  return errors;
}

}  // namespace

Result<Solver> Solver::create(const Rig& rig, Model model) {
  Solver solver;
  solver.model_ = model;
  MDOF_TRY(solver.fixture_, make_fixture(rig));
  const std::vector<bool> all(rig.probes.size(), true);
  solver.seen_ = visibility(solver.fixture_, all);
  if (!solver.seen_.complete()) {
    return bad_input(rig.source + ": " + describe_unseen(solver.fixture_, all, solver.seen_));
  }
  if (model != Model::rigid) {
    auto fixture = make_small_angle_fixture(solver.fixture_);
    if (!fixture) return in_context(rig.source, fixture.error());
    solver.small_angle_ = *fixture;
  }
  return solver;
}

AxisErrors Solver::solve(double travel_m, const std::vector<double>& readings_m,
                         const std::vector<double>& u_m) const {
  AxisErrors errors = solve_without_covariance(travel_m, readings_m, u_m);
  if (!errors.valid || u_m.size() != readings_m.size()) return errors;
  const std::vector<bool> use = usable(readings_m);
  errors.covariance = covariance(travel_m, errors, use, make_weights(use, u_m), u_m);
  return errors;
}

AxisErrors Solver::solve_without_covariance(double travel_m, const std::vector<double>& readings_m,
                                            const std::vector<double>& u_m) const {
  assert(readings_m.size() == fixture_.probes.size());
  const std::vector<bool> use = usable(readings_m);
  const bool complete = std::all_of(use.begin(), use.end(), [](bool u) { return u; });
  if (!complete) {
    const Visibility seen = visibility(fixture_, use);
    if (!seen.complete()) return not_seen(fixture_, use, seen);
  }
  if (model_ == Model::rigid)
    return solve_rigid(fixture_, travel_m, readings_m, make_weights(use, u_m));
  std::array<double, 5> m{};
  for (std::size_t k = 0; k < 5; ++k) m[k] = readings_m[small_angle_->probe[k]];
  AxisErrors errors;
  errors.local = solve_small_angle(model_, *small_angle_, travel_m, m);
  errors.valid = true;
  errors.reason.clear();
  return errors;
}

Eigen::MatrixXd Solver::gain(double travel_m, const AxisErrors& errors,
                             const std::vector<double>& weights) const {
  const Errors5 at = model_ == Model::rigid ? errors.local : Errors5{};
  const Eigen::MatrixXd J = rigid_jacobian(fixture_, travel_m, at);
  Eigen::VectorXd root_weight(J.rows());
  for (Eigen::Index i = 0; i < J.rows(); ++i)
    root_weight(i) = std::sqrt(weights[static_cast<std::size_t>(i)]);
  const Eigen::MatrixXd weighted = root_weight.asDiagonal() * J;
  return LeastSquares(weighted).solve(Eigen::MatrixXd(root_weight.asDiagonal()));
}

Eigen::MatrixXd Solver::gain(double travel_m, const AxisErrors& errors,
                             const std::vector<double>& readings_m,
                             const std::vector<double>& u_m) const {
  return gain(travel_m, errors, make_weights(usable(readings_m), u_m));
}

// First-order propagation (GUM 5.1.2): cov(e) = K diag(u²) Kᵀ, where K is the gain.
Covariance5 Solver::covariance(double travel_m, const AxisErrors& errors,
                               const std::vector<bool>& use, const std::vector<double>& weights,
                               const std::vector<double>& u_m) const {
  const Eigen::MatrixXd K = gain(travel_m, errors, weights);
  Eigen::VectorXd u2(K.cols());
  for (Eigen::Index i = 0; i < K.cols(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    u2(i) = use[k] ? u_m[k] * u_m[k] : 0.0;
  }
  const Eigen::MatrixXd cov = K * u2.asDiagonal() * K.transpose();
  Covariance5 out{};
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) out[static_cast<std::size_t>(5 * i + j)] = cov(i, j);
  }
  return out;
}

}  // namespace mdof::algo
