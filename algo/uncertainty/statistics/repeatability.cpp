#include "algo/uncertainty/statistics/repeatability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "algo/drift/run_drift.h"
#include "algo/iso230/target_changes.h"
#include "algo/sequence/run_drifts.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/statistics/run_shifts.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

struct Visit {
  int target = 0, run = 0, way = 0;  // way: 1 forward, 0 reverse
  double time_s = 0;
  Errors5 error{}, noise{}, residual{};  // noise: variance of the mean of the dwell
};

class Decomposition {
 public:
  Decomposition(const MovingAxis& moving, const std::vector<MeasuredPoint>& points) {
    std::vector<MeasuredPoint> passes;
    std::vector<Errors5> errors;
    std::map<int, int> ways;
    for (const MeasuredPoint& p : points) {
      if (!counts_in_means(p)) continue;
      Visit& visit = visits_.emplace_back();
      visit.target = p.target;
      visit.run = p.run;
      visit.way = p.point.direction > 0 ? 1 : 0;
      visit.time_s = middle_time_s(p);
      visit.error = named_from_local(moving, p.errors.local);
      const Covariance5 covariance = named_from_local(moving.axis, p.errors.covariance);
      for (std::size_t k = 0; k < kErrorCount; ++k) visit.noise[k] = covariance[6 * k];
      errors.push_back(visit.error);
      passes.push_back(p);
      passes.back().run = 2 * p.run + visit.way;
      ++ways[visit.way];
      ++visits_of_[{visit.target, visit.way}];
      ++visits_of_run_[visit.run];
    }
    if (visits_.empty()) return;
    const RunDrifts drifts(passes);
    shifts_ = drifts.of(errors);
    pass_of_ = drifts.point_runs();
    freedom_ = static_cast<double>(visits_.size() - visits_of_.size()) -
               static_cast<double>(shifts_.size() - ways.size());
    find_scatter();
  }

  double freedom() const { return freedom_; }
  double runs() const { return static_cast<double>(visits_of_run_.size()); }

  // True: the scatter of the visits exceeds their noise significantly. The test compares χ²/ν with
  // its 80 % point (normal approximation).
  bool by_scatter(std::size_t k) const {
    return freedom_ > 0 && scatter_[k] > noise_[k] * (1 + 0.84 * std::sqrt(2 / freedom_));
  }

  double pooled_variance(std::size_t k) const { return by_scatter(k) ? scatter_[k] : noise_[k]; }

  // For each target: variance of the mean of both approaches, or of the mean of its only approach.
  std::map<int, Errors5> variances() const {
    std::map<int, Errors5> sums;
    for (const Visit& visit : visits_) {
      const double n = visits_like(visit);
      Errors5& sum = sums[visit.target];
      for (std::size_t k = 0; k < kErrorCount; ++k) sum[k] += variance_of(visit, k) / (n * n);
    }
    return sums;
  }
  bool has_both(int target) const { return has(target, 0) && has(target, 1); }
  bool has_one_approach_only() const {
    return std::none_of(visits_.begin(), visits_.end(),
                        [this](const Visit& v) { return has_both(v.target); });
  }

  CorrelatedNoise correlated_noise(std::size_t k, const std::vector<TargetMean>& means) const {
    std::map<int, std::size_t> index;
    for (std::size_t i = 0; i < means.size(); ++i) index[means[i].target] = i;
    std::vector<NoisyVisit> noisy;
    for (std::size_t i = 0; i < visits_.size(); ++i)
      if (const Visit& v = visits_[i]; index.contains(v.target))
        noisy.push_back({index.at(v.target), pass_of_[i], v.time_s, 1 / visits_like(v),
                         visits_of_.at({v.target, v.way}) > 1 ? v.residual[k] : kNaN});
    std::stable_sort(noisy.begin(), noisy.end(),
                     [](const NoisyVisit& a, const NoisyVisit& b) { return a.time_s < b.time_s; });
    return {std::move(noisy), freedom_};
  }

  // Variance of the mean shift of the runs. The part that the scatter of the visits explains is
  // subtracted.
  Errors5 shift_variance() const {
    Errors5 variance{};
    const double n = runs();
    if (n < 2) return variance;
    std::map<int, std::pair<Errors5, double>> of_run;
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      auto& [sum, count] = of_run[visits_[i].run];
      for (std::size_t k = 0; k < kErrorCount; ++k) sum[k] += shifts_[pass_of_[i]][k];
      count += 1;
    }
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      double square = 0;
      for (const auto& [run, shift] : of_run) {
        const double of_this = shift.first[k] / shift.second;
        square += of_this * of_this;
      }
      const double by_scatter = scatter_[k] * n / static_cast<double>(visits_.size());
      variance[k] = std::max(0.0, square / (n - 1) - by_scatter) / n;
    }
    return variance;
  }

 private:
  // 1 / (weight of the visit in the mean of its target).
  double visits_like(const Visit& visit) const {
    return (has_both(visit.target) ? 2 : 1) *
           static_cast<double>(visits_of_.at({visit.target, visit.way}));
  }
  bool has(int target, int way) const { return visits_of_.contains({target, way}); }

  void find_scatter() {
    std::map<std::pair<int, int>, Errors5> means;
    std::vector<Errors5> settled;
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      Errors5& error = settled.emplace_back(visits_[i].error);
      Errors5& mean = means[{visits_[i].target, visits_[i].way}];
      for (std::size_t k = 0; k < kErrorCount; ++k) {
        error[k] -= shifts_[pass_of_[i]][k];
        mean[k] += error[k];
        noise_[k] += visits_[i].noise[k] / static_cast<double>(visits_.size());
      }
    }
    for (auto& [visit, mean] : means)
      for (double& of_error : mean) of_error /= static_cast<double>(visits_of_.at(visit));
    for (std::size_t i = 0; i < visits_.size() && freedom_ > 0; ++i)
      for (std::size_t k = 0; k < kErrorCount; ++k) {
        const double off = settled[i][k] - means.at({visits_[i].target, visits_[i].way})[k];
        visits_[i].residual[k] = off;
        scatter_[k] += off * off / freedom_;
      }
  }

  double variance_of(const Visit& visit, std::size_t k) const {
    if (!by_scatter(k)) return visit.noise[k];
    return noise_[k] > 0 ? visit.noise[k] * scatter_[k] / noise_[k] : scatter_[k];
  }

  std::vector<Visit> visits_;
  std::map<std::pair<int, int>, int> visits_of_;  // number of visits by target and way
  std::map<int, int> visits_of_run_;
  std::vector<Errors5> shifts_;       // one for each pass
  std::vector<std::size_t> pass_of_;  // index of the pass of each visit
  Errors5 scatter_{}, noise_{};       // variance of a visit from the residuals, and mean of the
                                      // variances of the dwells
  double freedom_ = 0;
};

// Changes of the means of both approaches if each error changes by its u: [part][target].
// `by_unit`: changes of the mean of each target and approach by one unit.
std::vector<std::vector<Errors5>> changes_of_both_approaches(
    const TargetChanges& changes, const std::vector<MeasuredPoint>& counted,
    const std::vector<std::map<TargetAndApproach, double>>& by_unit, const Errors5& u) {
  std::vector<std::vector<Errors5>> parts;
  for (const auto& part : by_unit) {
    std::vector<Errors5> all;
    for (const MeasuredPoint& p : counted) {
      Errors5& change = all.emplace_back();
      change.fill(part.at({p.target, p.point.direction > 0 ? 1 : 0}));
    }
    parts.push_back(changes.of(all));
    for (Errors5& of_target : parts.back())
      for (std::size_t k = 0; k < kErrorCount; ++k) of_target[k] *= u[k];
  }
  return parts;
}

void add_shared(Repeatability& found, const MovingAxis& moving,
                const std::vector<MeasuredPoint>& counted) {
  const TargetChanges changes(moving, counted);
  const PassLevels levels = pass_levels(moving, counted, found.u_visit);
  found.together =
      changes_of_both_approaches(changes, counted, parts_by_run_shifts(counted), found.u_visit);
  found.of_passes = changes_of_both_approaches(changes, counted, levels.parts, levels.u_half);
  found.passes_freedom = levels.freedom;
}

double without_part(double u, double part) {
  return std::sqrt(std::max(0.0, u * u - part * part));
}

// Adds the changes of named error k as a new part, unless all changes are 0.
void add_alone(std::vector<std::vector<Errors5>>& parts, const std::vector<Errors5>& changes,
               std::size_t k) {
  std::vector<Errors5> part(changes.size());
  bool any = false;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    part[i][k] = changes[i][k];
    any = any || part[i][k] != 0;
  }
  if (any) parts.push_back(std::move(part));
}

}  // namespace

Repeatability repeatability(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                            const std::vector<TargetMean>& means) {
  Repeatability found;
  std::vector<MeasuredPoint> counted;
  std::copy_if(points.begin(), points.end(), std::back_inserter(counted), counts_in_means);
  const Decomposition visits(moving, counted);
  const bool one_way = visits.has_one_approach_only(), uneven = any_run_lacks_visits(counted);
  const WithoutDrift without = uneven ? subtract_run_drifts(counted) : WithoutDrift{};
  const std::map<int, Errors5> variances = visits.variances();
  std::vector<Errors5> trend;  // one for each target
  // If runs lack visits, the levels of the runs are removed before the means are calculated.
  // u_shift is then the uncertainty of the level.
  for (const TargetMean& mean :
       uneven ? target_means(moving, without.points, Approach::both) : means) {
    Errors5& u = found.u.emplace_back(mean.u);
    trend.push_back(mean.u_trend);
    if (!one_way && !visits.has_both(mean.target)) {
      for (std::size_t k = 0; k < kErrorCount; ++k) u[k] = without_part(u[k], mean.u_trend[k]);
      continue;
    }
    const Errors5& variance = variances.at(mean.target);
    for (std::size_t k = 0; k < kErrorCount; ++k) u[k] = std::sqrt(variance[k]);
  }
  if (visits.freedom() > 0) found.freedom = visits.freedom();
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    found.by_scatter[k] = visits.by_scatter(k);
    if (found.by_scatter[k]) found.correlated[k] = visits.correlated_noise(k, means);
  }
  for (std::size_t k = 0; k < kErrorCount; ++k)
    found.u_visit[k] = std::sqrt(visits.pooled_variance(k));
  const Errors5 shift = visits.shift_variance();
  const Errors5 level = named_from_local(moving, without.u_level);
  for (std::size_t k = 0; k < kErrorCount; ++k)
    found.u_shift[k] = uneven ? std::abs(level[k]) : std::sqrt(shift[k]);
  if (uneven) add_shared(found, moving, counted);
  for (std::size_t k = 0; k < kErrorCount; ++k) add_alone(found.together, trend, k);
  if (visits.runs() > 1) found.shift_freedom = visits.runs() - 1;
  return found;
}

}  // namespace mdof::algo
