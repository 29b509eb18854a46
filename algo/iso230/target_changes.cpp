#include "algo/iso230/target_changes.h"

#include <map>

#include "algo/sequence/uneven_visits.h"

namespace mdof::algo {
namespace {

bool has_both(const std::array<std::size_t, 2>& visits) {
  return visits[0] > 0 && visits[1] > 0;
}

}  // namespace

TargetChanges::TargetChanges(const MovingAxis& moving, const std::vector<MeasuredPoint>& points)
    : moving_(moving) {
  std::map<int, std::size_t> targets;
  std::vector<MeasuredPoint> counted;
  for (const MeasuredPoint& p : points)
    if (counts_in_means(p)) {
      targets[p.target];
      counted.push_back(p);
    }
  for (auto& [target, place] : targets) {
    place = visits_.size();
    visits_.push_back({});
  }
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (!counts_in_means(points[j])) continue;
    const std::size_t target = targets.at(points[j].target);
    const std::size_t way = points[j].point.direction > 0 ? 0 : 1;
    counted_.push_back({target, way, j});
    ++visits_[target][way];
  }
  if (any_run_lacks_visits(counted)) drifts_.emplace(counted);
}

std::vector<Errors5> TargetChanges::without_drift(const std::vector<Errors5>& changes) const {
  std::vector<Errors5> errors;
  errors.reserve(counted_.size());
  for (const Counted& c : counted_) errors.push_back(changes[c.point]);
  if (!drifts_) return errors;
  const std::vector<Errors5> drifts = drifts_->of(errors);
  for (std::size_t i = 0; i < errors.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      errors[i][k] -= drifts[drifts_->point_runs()[i]][k];
  return errors;
}

TargetChanges::Ways TargetChanges::direction_means(const std::vector<Errors5>& errors) const {
  Ways means;
  means.fill(std::vector<Errors5>(visits_.size(), Errors5{}));
  for (std::size_t i = 0; i < errors.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      means[counted_[i].way][counted_[i].target][k] += errors[i][k];
  for (std::size_t way = 0; way < 2; ++way)
    for (std::size_t t = 0; t < visits_.size(); ++t)
      for (std::size_t k = 0; k < kErrorCount && visits_[t][way] > 0; ++k)
        means[way][t][k] /= static_cast<double>(visits_[t][way]);
  return means;
}

Errors5 TargetChanges::mean_reversal(const Ways& ways) const {
  Errors5 sum{};
  double n = 0;
  for (std::size_t t = 0; t < visits_.size(); ++t) {
    if (!has_both(visits_[t])) continue;
    n += 1;
    for (std::size_t k = 0; k < kErrorCount; ++k) sum[k] += ways[0][t][k] - ways[1][t][k];
  }
  for (double& of_error : sum) of_error = n > 0 ? of_error / n : 0.0;
  return sum;
}

std::vector<Errors5> TargetChanges::of(const std::vector<Errors5>& changes) const {
  const Ways ways = direction_means(without_drift(changes));
  const Errors5 reversal = mean_reversal(ways);
  std::vector<Errors5> named;
  named.reserve(visits_.size());
  for (std::size_t t = 0; t < visits_.size(); ++t) {
    Errors5 mean{};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      mean[k] = has_both(visits_[t]) ? 0.5 * (ways[0][t][k] + ways[1][t][k])
                : visits_[t][0] > 0  ? ways[0][t][k] - 0.5 * reversal[k]
                                     : ways[1][t][k] + 0.5 * reversal[k];
    named.push_back(named_from_local(moving_, mean));
  }
  return named;
}

}  // namespace mdof::algo
