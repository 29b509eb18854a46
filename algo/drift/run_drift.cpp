#include "algo/drift/run_drift.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/linear_algebra/least_squares.h"
#include "algo/sensitivity/plan/functions.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLogLikelihoodRatio = 5;       // smallest value for a drift instead of steps
constexpr std::size_t kLeastPointsPerPass = 3;  // average over the passes
constexpr double kLeastScatter_m = 1e-12;
constexpr double kNoticeable = 2;  // standard uncertainties

using Points = std::vector<const MeasuredPoint*>;

Points usable_for_drift(const std::vector<MeasuredPoint>& points) {
  Points out;
  for (const MeasuredPoint& p : points)
    if (p.errors.valid && p.point.direction != 0) out.push_back(&p);
  return out;
}

DriftDesign design_of(const Points& points) {
  std::map<std::pair<int, int>, std::size_t> places;
  std::vector<TimedVisit> visits;
  for (const MeasuredPoint* p : points) {
    const auto place = places.emplace(std::pair(p->target, p->point.direction), places.size());
    visits.push_back({place.first->second, middle_time_s(*p)});
  }
  return DriftDesign(std::move(visits));
}

DriftFit errors_fit(const Points& points) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd y(n, kErrorCount);
  Eigen::VectorXd noise2 = Eigen::VectorXd::Zero(kErrorCount);
  for (Eigen::Index i = 0; i < n; ++i) {
    const AxisErrors& errors = points[static_cast<std::size_t>(i)]->errors;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      y(i, static_cast<Eigen::Index>(k)) = errors.local[k];
      noise2(static_cast<Eigen::Index>(k)) += errors.covariance[6 * k] / static_cast<double>(n);
    }
  }
  return {design_of(points), y, noise2};
}

// Uses only points that have readings of all probes.
std::vector<SeriesDrift> probe_drifts(const Points& points) {
  Points whole;
  std::copy_if(points.begin(), points.end(), std::back_inserter(whole), [](const auto* p) {
    return std::none_of(p->point.probe_m.begin(), p->point.probe_m.end(),
                        [](double x) { return std::isnan(x); });
  });
  const std::size_t probes = points.empty() ? 0 : points.front()->point.probe_m.size();
  const auto n = static_cast<Eigen::Index>(whole.size());
  Eigen::MatrixXd y(n, static_cast<Eigen::Index>(probes));
  Eigen::VectorXd noise2 = Eigen::VectorXd::Zero(y.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point& p = whole[static_cast<std::size_t>(i)]->point;
    for (std::size_t k = 0; k < probes; ++k) {
      y(i, static_cast<Eigen::Index>(k)) = p.probe_m[k];
      noise2(static_cast<Eigen::Index>(k)) +=
          p.probe_u_m[k] * p.probe_u_m[k] / static_cast<double>(n);
    }
  }
  return DriftFit(design_of(whole), y, noise2).series();
}

std::vector<Closure> find_closures(const Points& points) {
  std::vector<Closure> closures;
  std::set<int> begun;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MeasuredPoint& start = *points[i];
    if (!begun.insert(start.run).second) continue;
    const MeasuredPoint* end = nullptr;
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (points[j]->target != start.target) continue;
      end = points[j];
      if (end->point.direction == start.point.direction) break;
    }
    if (!end) continue;
    Closure closure{start.run,
                    middle_time_s(*end) - middle_time_s(start),
                    end->point.direction == start.point.direction,
                    {}};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      closure.change[k] = end->errors.local[k] - start.errors.local[k];
    closures.push_back(closure);
  }
  return closures;
}

// The group of each value. All values of a group have the same unknown mean.
using Groups = std::vector<std::size_t>;

void subtract_group_means(const Groups& groups, Eigen::MatrixXd& columns) {
  const std::size_t n = 1 + *std::max_element(groups.begin(), groups.end());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), columns.cols());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
  const auto group = [&](Eigen::Index i) {
    return static_cast<Eigen::Index>(groups[static_cast<std::size_t>(i)]);
  };
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    sum.row(group(i)) += columns.row(i);
    count(group(i)) += 1;
  }
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    columns.row(i) -= sum.row(group(i)) / count(group(i));
}

// Returns the residual sum of squares of y after a fit of the columns and of a mean for each group.
double residual_square(Eigen::MatrixXd columns, Eigen::MatrixXd y, const Groups& groups) {
  subtract_group_means(groups, columns);
  subtract_group_means(groups, y);
  const Eigen::MatrixXd fitted = columns * LeastNorm(columns).solve(y);
  return (y - fitted).squaredNorm();
}

// The target and the pass of each point. A pass is a sequence of points of one run in one
// direction.
struct Grouping {
  Groups target, pass;
  std::size_t passes = 0;
};

Grouping grouping_of(const Points& points) {
  Grouping out;
  std::map<int, std::size_t> targets;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MeasuredPoint& p = *points[i];
    out.target.push_back(targets.emplace(p.target, targets.size()).first->second);
    const bool same =
        i > 0 && points[i - 1]->run == p.run && points[i - 1]->point.direction == p.point.direction;
    out.passes += same ? 0 : 1;
    out.pass.push_back(out.passes - 1);
  }
  return out;
}

// Returns whether steps from pass to pass explain the error as well as a drift. Both models have
// the same reversal at all targets.
bool may_be_steps(const Points& points, const DriftFit& fit, std::size_t k) {
  const Grouping groups = grouping_of(points);
  const auto n = static_cast<Eigen::Index>(points.size());
  if (kLeastPointsPerPass * groups.passes > points.size()) return true;
  const int order = fit.series()[k].order;
  Eigen::MatrixXd y(n, 1), drift(n, order + 1);
  Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(groups.passes));
  for (Eigen::Index i = 0; i < n; ++i) {
    const MeasuredPoint& p = *points[static_cast<std::size_t>(i)];
    y(i, 0) = p.errors.local[k];
    drift(i, 0) = p.point.direction;
    drift.row(i).tail(order) = fit.design().polynomials(middle_time_s(p)).head(order).transpose();
    steps(i, static_cast<Eigen::Index>(groups.pass[static_cast<std::size_t>(i)])) = 1;
  }
  const double least = static_cast<double>(n) * kLeastScatter_m * kLeastScatter_m;
  const double of_drift = std::max(residual_square(drift, y, groups.target), least);
  const double of_steps = std::max(residual_square(steps, y, groups.target), least);
  return 0.5 * static_cast<double>(n) * natural_log(of_steps / of_drift) < kLogLikelihoodRatio;
}

std::string unseen_reason(const DriftDesign& design) {
  if (design.visits().empty())
    return "the approach direction is unknown at all points with calculated errors";
  return "too few targets were approached twice or more from the same direction, so a drift cannot "
         "be "
         "separated from the errors of the axis; measure two runs or more";
}

}  // namespace

double middle_time_s(const MeasuredPoint& point) {
  return (ns_to_s(point.point.begin_ns) + ns_to_s(point.point.end_ns)) / 2;
}

bool RunDrift::significant() const {
  return std::any_of(errors.begin(), errors.end(), [](const auto& e) { return e.significant(); });
}

bool RunDrift::removable() const {
  return std::any_of(errors.begin(), errors.end(),
                     [](const auto& e) { return e.significant() && !e.steps; });
}

DriftOfRun::DriftOfRun(const std::vector<MeasuredPoint>& points) {
  const Points report = usable_for_drift(points);
  found_.closures = find_closures(report);
  if (report.empty()) {
    found_.not_seen = unseen_reason(design_of(report));
    return;
  }
  found_.length_s = middle_time_s(*report.back()) - middle_time_s(*report.front());
  fit_.emplace(errors_fit(report));
  if (fit_->design().orders() == 0) {
    found_.not_seen = unseen_reason(fit_->design());
    fit_.reset();
    return;
  }
  for (std::size_t k = 0; k < kErrorCount; ++k)
    if (fit_->series()[k].significant() && may_be_steps(report, *fit_, k)) fit_->mark_as_steps(k);
  std::copy_n(fit_->series().begin(), kErrorCount, found_.errors.begin());
  found_.probes = probe_drifts(report);
}

std::vector<MeasuredPoint> DriftOfRun::without(std::vector<MeasuredPoint> points) const {
  if (!fit_ || !found_.removable()) return points;
  for (MeasuredPoint& p : points) {
    if (!p.errors.valid) continue;
    const Eigen::VectorXd drift = fit_->drift(middle_time_s(p));
    for (std::size_t k = 0; k < kErrorCount; ++k)
      p.errors.local[k] -= drift(static_cast<Eigen::Index>(k));
  }
  return points;
}

Errors5 DriftOfRun::left_in_reversal(const std::vector<MeasuredPoint>& points,
                                     bool is_removed) const {
  struct Approach {
    double n = 0;
    Errors5 course{}, u2{};  // sums over the visits
  };
  Errors5 largest{};
  if (!fit_ || !found_.significant()) return largest;
  std::map<int, std::array<Approach, 2>> targets;
  for (const MeasuredPoint* p : usable_for_drift(points)) {
    Approach& to = targets[p->target][p->point.direction < 0 ? 1 : 0];
    const Eigen::VectorXd course = fit_->course(middle_time_s(*p));
    ++to.n;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const bool is_left = found_.errors[k].significant() &&
                           !(is_removed && found_.removable() && !found_.errors[k].steps);
      to.course[k] += is_left ? course(static_cast<Eigen::Index>(k)) : 0;
      to.u2[k] += p->errors.covariance[6 * k];
    }
  }
  for (const auto& [target, approaches] : targets) {
    const auto& [forward, reverse] = approaches;
    if (forward.n == 0 || reverse.n == 0) continue;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double change = reverse.course[k] / reverse.n - forward.course[k] / forward.n;
      const double u = std::sqrt(reverse.u2[k] / (reverse.n * reverse.n) +
                                 forward.u2[k] / (forward.n * forward.n));
      if (std::abs(change) > kNoticeable * u && std::abs(change) > std::abs(largest[k]))
        largest[k] = change;
    }
  }
  return largest;
}

double DriftOfRun::freedom() const {
  return fit_ ? fit_->freedom() : 0;
}

std::vector<std::vector<Errors5>> DriftOfRun::removal_shifts(
    const std::vector<MeasuredPoint>& points) const {
  if (!fit_ || !found_.removable()) return {};
  std::vector<double> time_s;
  for (const MeasuredPoint& p : points) time_s.push_back(middle_time_s(p));
  const std::vector<Eigen::MatrixXd> all = fit_->parts(time_s);
  std::vector<std::vector<Errors5>> parts(static_cast<std::size_t>(all.front().cols()),
                                          std::vector<Errors5>(points.size()));
  for (std::size_t j = 0; j < points.size(); ++j)
    for (std::size_t part = 0; part < parts.size() && points[j].errors.valid; ++part)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        parts[part][j][k] = all[j](static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(part));
  return parts;
}

}  // namespace mdof::algo
