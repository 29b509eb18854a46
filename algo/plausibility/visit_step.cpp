#include "algo/plausibility/visit_step.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algo/linear_algebra/least_squares.h"
#include "algo/points/flags.h"
#include "algo/points/median.h"
#include "algo/sensitivity/plan/functions.h"
#include "algo/uncertainty/statistics/visit_scatter.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLeastStepInScatter = 6, kLogRatioToSmooth = 10;
constexpr double kLeastStep_m = 1e-9;
// Smallest sum of (visits before the step · visits after the step)/visits over the places. A place
// with one visit before and one visit after the step contributes 1/2.
constexpr double kLeastStepWeight = 2;
// Smallest number of degrees of freedom of the residuals after the fit of places and a step.
constexpr double kFewestFreedom = 4;
constexpr Eigen::Index kSmooth = 6;  // order of the polynomial of a smooth change
constexpr std::size_t kFewestCopies = 6;
constexpr double kCopiedShare = 0.1;  // smallest share of copied points that is reported

using ProbeVisits = std::vector<const MeasuredPoint*>;

// Returns the visits with a reading of this probe in the order of time.
ProbeVisits visits_of(const std::vector<MeasuredPoint>& points, std::size_t probe) {
  ProbeVisits visits;
  for (const MeasuredPoint& p : points)
    if (p.point.direction != 0 && !std::isnan(p.point.probe_m[probe])) visits.push_back(&p);
  return visits;
}

// Subtracts from each value the mean of its place.
class AtPlaces {
 public:
  explicit AtPlaces(const ProbeVisits& visits) {
    std::map<std::pair<int, int>, Eigen::Index> places;
    for (const MeasuredPoint* p : visits) {
      const std::pair key(p->target, p->point.direction);
      place_.push_back(places.emplace(key, static_cast<Eigen::Index>(places.size())).first->second);
    }
    count_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(places.size()));
    for (const Eigen::Index place : place_) count_(place) += 1;
  }
  Eigen::Index places() const { return count_.size(); }
  Eigen::Index of(std::size_t visit) const { return place_[visit]; }
  double visits(Eigen::Index place) const { return count_(place); }
  Eigen::MatrixXd centred(Eigen::MatrixXd y) const {
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(count_.size(), y.cols());
    for (std::size_t i = 0; i < place_.size(); ++i)
      mean.row(place_[i]) += y.row(static_cast<Eigen::Index>(i)) / count_(place_[i]);
    for (std::size_t i = 0; i < place_.size(); ++i)
      y.row(static_cast<Eigen::Index>(i)) -= mean.row(place_[i]);
    return y;
  }

 private:
  std::vector<Eigen::Index> place_;
  Eigen::VectorXd count_;
};

struct Jump {
  std::size_t visit = 0;  // first visit after the jump
  double size = 0, explains = 0;
};

// Returns the single step after whose subtraction the residuals of `y` are smallest. The mean of
// each place is already subtracted from `y`.
Jump largest_jump(const AtPlaces& at, const Eigen::VectorXd& y) {
  Eigen::VectorXd after = Eigen::VectorXd::Zero(at.places());
  double sum = 0, weight = 0;
  Jump best;
  for (auto i = static_cast<std::size_t>(y.size()); i-- > 1;) {
    const Eigen::Index place = at.of(i);
    const double n = at.visits(place);
    weight -= after(place) * (n - after(place)) / n;
    after(place) += 1;
    weight += after(place) * (n - after(place)) / n;
    sum += y(static_cast<Eigen::Index>(i));
    if (weight < kLeastStepWeight || sum * sum / weight <= best.explains) continue;
    best = {i, sum / weight, sum * sum / weight};
  }
  return best;
}

double smooth_residual_square(const AtPlaces& at, const ProbeVisits& visits,
                              const Eigen::VectorXd& y) {
  const double begin = ns_to_s(visits.front()->point.begin_ns);
  const double length = ns_to_s(visits.back()->point.begin_ns) - begin;
  if (!(length > 0)) return 0;
  Eigen::MatrixXd powers(y.size(), kSmooth);
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double time_s = ns_to_s(visits[static_cast<std::size_t>(i)]->point.begin_ns);
    const double x = 2 * (time_s - begin) / length - 1;
    for (Eigen::Index k = 0; k < kSmooth; ++k) powers(i, k) = k == 0 ? x : powers(i, k - 1) * x;
  }
  const Eigen::MatrixXd columns = at.centred(std::move(powers));
  return (y - columns * LeastNorm(columns).solve(y)).squaredNorm();
}

// Returns the median of u² over the visits. The mean is not used, because the step increases the u²
// of a visit that contains it.
double usual_u2(const ProbeVisits& visits, std::size_t probe) {
  std::vector<double> all;
  for (const MeasuredPoint* p : visits) {
    const double u = p->point.probe_u_m[probe];
    if (u > 0) all.push_back(u * u);
  }
  return all.empty() ? 0 : median_of(std::move(all));
}

// Returns whether ProbeWatch has already found a step of this probe.
bool stepped_before(const ProbeVisits& visits, const std::string& id) {
  return std::any_of(visits.begin(), visits.end(),
                     [&](const MeasuredPoint* p) { return has_flag(p->point, Flag::step, id); });
}

// Returns whether both points contain the same scans, or have identical means of all probes.
// Readings without noise, or with noise below their resolution, can be identical by chance and are
// ignored.
bool same_readings(const Point& a, const Point& b) {
  const bool same_scans = a.scan_fingerprint != 0 && a.scan_fingerprint == b.scan_fingerprint;
  return (same_scans || (a.probe_m == b.probe_m && a.position_m == b.position_m)) &&
         !a.probe_sd_m.empty() &&
         std::all_of(a.probe_sd_m.begin(), a.probe_sd_m.end(), [](double sd) { return sd > 0; });
}

// Returns the number of points whose readings are copies of an earlier visit of the same place.
std::size_t count_copies(const std::vector<MeasuredPoint>& points) {
  std::map<std::pair<int, int>, std::vector<const MeasuredPoint*>> before;
  std::size_t copies = 0;
  for (const MeasuredPoint& p : points) {
    auto& same_place = before[{p.target, p.point.direction}];
    copies += std::any_of(same_place.begin(), same_place.end(), [&](const MeasuredPoint* other) {
      return same_readings(p.point, other->point);
    });
    same_place.push_back(&p);
  }
  return copies;
}

}  // namespace

std::vector<VisitStep> visit_steps(const Rig& rig, const std::vector<MeasuredPoint>& points) {
  std::vector<VisitStep> steps;
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const ProbeVisits visits = visits_of(points, k);
    if (visits.empty() || stepped_before(visits, rig.probes[k].id)) continue;
    const AtPlaces at(visits);
    const double freedom =
        static_cast<double>(visits.size()) - static_cast<double>(at.places()) - 2;
    if (freedom < kFewestFreedom) continue;
    Eigen::VectorXd y(static_cast<Eigen::Index>(visits.size()));
    for (std::size_t i = 0; i < visits.size(); ++i)
      y(static_cast<Eigen::Index>(i)) = visits[i]->point.probe_m[k];
    y = at.centred(y);
    const double noise2 =
        std::max(std::pow(kLeastStep_m / kLeastStepInScatter, 2), usual_u2(visits, k));
    const Jump jump = largest_jump(at, y);
    const double sd2 = std::max((y.squaredNorm() - jump.explains) / freedom, noise2);
    if (std::abs(jump.size) < kLeastStepInScatter * std::sqrt(sd2)) continue;
    const double smooth2 = smooth_residual_square(at, visits, y) / freedom;
    if (!(smooth2 > sd2) || 0.5 * freedom * natural_log(smooth2 / sd2) < kLogRatioToSmooth)
      continue;
    const auto point = static_cast<std::size_t>(visits[jump.visit] - points.data());
    steps.push_back({k, point, jump.size, std::sqrt(sd2)});
  }
  return steps;
}

Notices repeat_notices(const Rig& rig, const std::vector<MeasuredPoint>& points) {
  Notices out;
  for (const VisitStep& step : visit_steps(rig, points)) {
    const MeasuredPoint& p = points[step.point];
    out.push_back(notice(NoticeCode::readings_changed, rig.probes[step.probe].id,
                         {{"step_um", to_um(step.size_m)},
                          {"run", p.run},
                          {"target", p.target},
                          {"approach", p.point.direction > 0 ? "forward" : "reverse"}}));
  }
  const std::size_t copies = count_copies(points);
  if (copies >= kFewestCopies &&
      kCopiedShare * static_cast<double>(points.size()) <= static_cast<double>(copies))
    out.push_back(
        notice(NoticeCode::readings_copied, "", {{"copies", copies}, {"points", points.size()}}));
  if (VisitScatter(points).are_single()) out.push_back(notice(NoticeCode::visited_once));
  return out;
}

}  // namespace mdof::algo
