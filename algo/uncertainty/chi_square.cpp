#include "algo/uncertainty/chi_square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "algo/linear_algebra/least_squares.h"
#include "algo/model/rigid.h"
#include "algo/points/flags.h"
#include "algo/uncertainty/effects/reading_covariance.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLinearity = 1e-4;  // relative to the range of the probe
constexpr double kLever_m = 0.02;    // converts an angle to a length
// Relative to the largest variance: a smaller variance is rounding.
constexpr double kLeastPart = 1e-11;

bool flagged(const MeasuredPoint& p) {
  return has_flag(p.point, Flag::residual);
}

double square_distance(const Errors5& a, const Errors5& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const double difference = (a[k] - b[k]) * (k < 2 ? 1 : kLever_m);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

bool Agreement::explained() const {
  return freedom <= 0 || chi_square <= chi_square_limit(freedom);
}

Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const Eigen::MatrixXd& covariance, const AxisErrors& errors) {
  if (!errors.valid || solver.model() != Model::rigid) return {};
  std::vector<Eigen::Index> used;
  for (std::size_t k = 0; k < readings_m.size(); ++k)
    if (std::isfinite(readings_m[k])) used.push_back(static_cast<Eigen::Index>(k));
  const auto n = static_cast<Eigen::Index>(used.size());
  if (n <= 5) return {};
  const Eigen::VectorXd model = rigid_readings(solver.fixture(), travel_m, errors.local);
  const Eigen::MatrixXd all = rigid_jacobian(solver.fixture(), travel_m, errors.local);
  Eigen::MatrixXd jacobian(n, 5), tied(n, n);
  Eigen::VectorXd left(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = used[static_cast<std::size_t>(i)];
    left(i) = readings_m[static_cast<std::size_t>(k)] - model(k);
    for (Eigen::Index j = 0; j < 5; ++j) jacobian(i, j) = all(k, j);
    for (Eigen::Index j = 0; j < n; ++j)
      tied(i, j) = covariance(k, used[static_cast<std::size_t>(j)]);
  }
  const Eigen::MatrixXd seen = LeastSquares(jacobian).basis();
  const Eigen::MatrixXd unseen = Eigen::MatrixXd::Identity(n, n) - seen * seen.transpose();
  const Eigen::VectorXd contradiction = unseen * left;
  const Eigen::MatrixXd of_it = unseen * tied * unseen;
  return {static_cast<int>(n) - 5,
          contradiction.dot(LeastNorm(of_it, kLeastPart).solve(contradiction))};
}

Residuals::Residuals(const Solver& solver, const std::vector<double>& range_m, const Rig& rig,
                     std::int64_t start_ns)
    : Residuals(solver, range_m, rig.sides) {
  if (rig.declares_uncertainty()) rig_ = &rig;
  start_ns_ = start_ns;
}

Residuals::Residuals(const Solver& solver, const std::vector<double>& range_m, const Sides& sides)
    : solver_(solver), sides_(sides) {
  for (const double range : range_m) linearity_m_.push_back(kLinearity * range / std::sqrt(3.0));
}

std::vector<double> Residuals::allowed(const std::vector<double>& u_m) const {
  std::vector<double> all(u_m.size());
  for (std::size_t k = 0; k < u_m.size(); ++k) all[k] = std::hypot(u_m[k], linearity_m_[k]);
  return all;
}

void Residuals::test(MeasuredPoint& p) const {
  const Point& point = p.point;
  if (point.probe_m.size() <= 5) return;
  if (!explained(p, point.probe_m, p.errors)) add_flag(p.point, Flag::residual);
}

// Tests first with noise and linearity only, which is fast. If they do not explain the residuals,
// tests again with the declared uncertainties included.
bool Residuals::explained(const MeasuredPoint& p, const std::vector<double>& readings_m,
                          const AxisErrors& errors) const {
  const double travel_m = sides_.target_travel_m(p.point.position_m);
  const std::vector<double> u_m = allowed(p.point.probe_u_m);
  Eigen::MatrixXd covariance =
      Eigen::Map<const Eigen::VectorXd>(u_m.data(), static_cast<Eigen::Index>(u_m.size()))
          .cwiseAbs2()
          .asDiagonal();
  if (agreement(solver_, travel_m, readings_m, covariance, errors).explained()) return true;
  if (!rig_) return false;
  covariance += declared_covariance(*rig_, solver_, travel_m, errors.local, readings_m,
                                    ns_to_s(p.point.begin_ns - start_ns_));
  return agreement(solver_, travel_m, readings_m, covariance, errors).explained();
}

// Measure of the disagreement of the readings without `probe`. Infinite if the other readings do
// not agree. Otherwise the mean square distance between the errors without `probe` and the errors
// of the unflagged points of the same target. This distance is needed if the readings agree without
// any one of several probes.
double Residuals::misfit_without(std::size_t probe, const MeasuredPoint& p,
                                 const std::vector<MeasuredPoint>& all) const {
  const double travel_m = sides_.target_travel_m(p.point.position_m);
  std::vector<double> readings_m = p.point.probe_m;
  readings_m[probe] = kNaN;
  const AxisErrors errors = solver_.solve_without_covariance(travel_m, readings_m, {});
  if (!errors.valid) return std::numeric_limits<double>::infinity();
  if (!explained(p, readings_m, errors)) return std::numeric_limits<double>::infinity();
  double sum = 0;
  std::size_t n = 0;
  for (const MeasuredPoint& other : all) {
    if (other.target != p.target || flagged(other) || !other.errors.valid) continue;
    const auto sound = solver_.solve_without_covariance(
        sides_.target_travel_m(other.point.position_m), other.point.probe_m, {});
    sum += square_distance(errors.local, sound.local);
    ++n;
  }
  return n > 0 ? sum / static_cast<double>(n) : 0;
}

std::optional<std::size_t> Residuals::suspect(const std::vector<const MeasuredPoint*>& bad,
                                              const std::vector<MeasuredPoint>& all) const {
  std::optional<std::size_t> best;
  double least = 0, next = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < linearity_m_.size(); ++k) {
    double misfit = 0;
    for (const MeasuredPoint* p : bad) misfit += misfit_without(k, *p, all);
    if (!std::isfinite(misfit)) continue;
    if (!best || misfit < least) {
      if (best) next = std::min(next, least);
      best = k;
      least = misfit;
    } else {
      next = std::min(next, misfit);
    }
  }
  // Empty if two probes are about equally suspect.
  return best && 2 * least < next ? best : std::nullopt;
}

std::optional<Notice> Residuals::contradiction(const std::vector<MeasuredPoint>& points) const {
  std::vector<const MeasuredPoint*> bad;
  double most_m = 0;
  for (const MeasuredPoint& p : points) {
    if (!flagged(p)) continue;
    bad.push_back(&p);
    most_m = std::max(most_m, p.errors.residual_m);
  }
  if (bad.empty()) return std::nullopt;
  const auto probe = suspect(bad, points);
  return notice(NoticeCode::probes_contradict, probe ? solver_.fixture().probes[*probe].id : "",
                {{"points", bad.size()}, {"of", points.size()}, {"residual_um", to_um(most_m)}});
}

}  // namespace mdof::algo
