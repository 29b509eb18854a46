#include "algo/compensation/table_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/statistics/repeatability.h"
#include "algo/uncertainty/statistics/run_shifts.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

bool has_approach(const MeasuredPoint& p, Approach approach) {
  return counts_in_means(p) && (p.point.direction > 0) == (approach == Approach::forward);
}

// Variances of the means of one approach at the positions of the table.
struct ApproachVariances {
  std::vector<Errors5> variance;  // 0: the approach has no mean here
  std::vector<bool> has;
  Errors5 shift{};    // variance of the shift that all means have in common
  Errors5 u_visit{};  // u of one visit, pooled over all targets
};

ApproachVariances approach_variances(const MovingAxis& moving,
                                     const std::vector<MeasuredPoint>& points,
                                     const std::vector<TargetMean>& grid, Approach approach) {
  ApproachVariances out{std::vector<Errors5>(grid.size()), std::vector<bool>(grid.size()), {}, {}};
  std::vector<MeasuredPoint> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own),
               [&](const MeasuredPoint& p) { return has_approach(p, approach); });
  if (own.empty()) return out;
  const auto means = target_means(moving, own, approach);
  const Repeatability random = repeatability(moving, own, means);
  std::map<int, std::size_t> place;
  for (std::size_t i = 0; i < grid.size(); ++i) place[grid[i].target] = i;
  for (std::size_t m = 0; m < means.size(); ++m) {
    const auto at = place.find(means[m].target);
    if (at == place.end()) continue;
    out.has[at->second] = true;
    for (std::size_t k = 0; k < kErrorCount; ++k)
      out.variance[at->second][k] = random.u[m][k] * random.u[m][k];
  }
  for (std::size_t k = 0; k < kErrorCount; ++k)
    out.shift[k] = random.u_shift[k] * random.u_shift[k];
  out.u_visit = random.u_visit;
  return out;
}

// Runs with missing visits do not shift all means equally. This class calculates how two causes
// change the means of each approach, as independent parts: the uncertain shifts of these runs, and
// the different levels of their two passes (run_shifts.h).
class MissingVisitEffects {
 public:
  // `u_visit`: named errors.
  MissingVisitEffects(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                      const std::vector<TargetMean>& grid, const Errors5& u_visit)
      : grid_(grid), u_visit_(u_visit) {
    std::vector<MeasuredPoint> counted;
    std::copy_if(points.begin(), points.end(), std::back_inserter(counted), counts_in_means);
    by_noise_ = parts_by_run_shifts(counted);
    levels_ = pass_levels(moving, counted, u_visit);
    run_level_ = named_from_local(moving, subtract_run_drifts(points).u_level);
  }
  bool has_levels() const { return !levels_.parts.empty(); }
  double run_level(std::size_t k) const { return std::abs(run_level_[k]); }
  // Returns [part][target of the grid] for named error k; 0 if the approach has no mean at this
  // target.
  std::vector<std::vector<double>> of(Approach approach, std::size_t k) const {
    std::vector<std::vector<double>> parts;
    for (const auto& part : by_noise_) parts.push_back(on_grid(approach, part, u_visit_[k]));
    for (const auto& part : levels_.parts)
      parts.push_back(on_grid(approach, part, levels_.u_half[k]));
    return parts;
  }

 private:
  std::vector<double> on_grid(Approach approach, const std::map<TargetAndApproach, double>& part,
                              double u) const {
    std::vector<double> changes;
    for (const TargetMean& mean : grid_) {
      const auto at = part.find({mean.target, approach == Approach::forward ? 1 : 0});
      changes.push_back(at == part.end() ? 0.0 : u * at->second);
    }
    return changes;
  }

  const std::vector<TargetMean>& grid_;
  Errors5 u_visit_, run_level_{};  // run_level_: u of the means due to the levels of runs
  std::vector<std::map<TargetAndApproach, double>> by_noise_;
  PassLevels levels_;
};

// Half of the difference between the two approaches varies from run to run. Returns the variance of
// the mean of this half difference over all targets with both approaches, without the contribution
// of the noise of single visits.
Errors5 half_difference(const MovingAxis& moving, const std::vector<MeasuredPoint>& points) {
  struct Sums {
    std::array<Errors5, 2> sum{};
    std::array<double, 2> visits{};
  };
  std::map<std::pair<int, int>, Sums> at_target;  // key: run and target
  for (const MeasuredPoint& p : points) {
    if (!counts_in_means(p)) continue;
    Sums& sums = at_target[{p.run, p.target}];
    const std::size_t way = p.point.direction > 0 ? 1 : 0;
    const Errors5 named = named_from_local(moving, p.errors.local);
    for (std::size_t k = 0; k < kErrorCount; ++k) sums.sum[way][k] += named[k];
    sums.visits[way] += 1;
  }
  struct Halves {
    Errors5 sum{}, square{};
    double targets = 0;
  };
  std::map<int, Halves> of_run;
  std::map<int, Errors5> of_target;
  std::map<int, double> runs_at;
  const auto side_half_mean = [](const Sums& sums, std::size_t k) {
    return (sums.sum[1][k] / sums.visits[1] - sums.sum[0][k] / sums.visits[0]) / 2;
  };
  for (const auto& [where, sums] : at_target) {
    if (sums.visits[0] == 0 || sums.visits[1] == 0) continue;
    runs_at[where.second] += 1;
    for (std::size_t k = 0; k < kErrorCount; ++k)
      of_target[where.second][k] += side_half_mean(sums, k);
  }
  // Subtract the mean reversal of each target, so that runs with different targets are comparable.
  for (const auto& [where, sums] : at_target) {
    if (sums.visits[0] == 0 || sums.visits[1] == 0) continue;
    Halves& run = of_run[where.first];
    run.targets += 1;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double off =
          side_half_mean(sums, k) - of_target[where.second][k] / runs_at[where.second];
      run.sum[k] += off;
      run.square[k] += off * off;
    }
  }
  Errors5 variance{};
  const auto runs = static_cast<double>(of_run.size());
  if (runs < 2) return variance;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    double square = 0, by_visits = 0;
    for (const auto& [run, halves] : of_run) {
      const double mean = halves.sum[k] / halves.targets;
      square += mean * mean / (runs - 1);
      if (halves.targets > 1)
        by_visits +=
            (halves.square[k] / halves.targets - mean * mean) / (halves.targets - 1) / runs;
    }
    variance[k] = std::max(0.0, square - by_visits) / runs;
  }
  return variance;
}

}  // namespace

Reference as_measured(std::size_t targets) {
  return Reference(targets, 0.0);
}

Reference interpolation_at(const std::vector<double>& x, double at) {
  Reference shares(x.size(), 0.0);
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin() || above == x.end()) {
    shares[above == x.begin() ? 0 : x.size() - 1] = 1;
    return shares;
  }
  const auto i = static_cast<std::size_t>(above - x.begin());
  shares[i] = (at - x[i - 1]) / (x[i] - x[i - 1]);
  shares[i - 1] = 1 - shares[i];
  return shares;
}

Reference line_at(const std::vector<double>& x, double at) {
  const auto n = static_cast<double>(x.size());
  double mean = 0, square = 0;
  for (const double v : x) mean += v / n;
  for (const double v : x) square += (v - mean) * (v - mean);
  Reference shares;
  for (const double v : x) shares.push_back(1 / n + (at - mean) * (v - mean) / square);
  return shares;
}

SeriesOfErrors table_uncertainty(
    const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
    const std::vector<TargetMean>& grid, Approach approach,
    const std::array<std::vector<Reference>, kErrorCount>& references) {
  const bool is_mean = approach == Approach::both;
  const Approach first = is_mean ? Approach::forward : approach;
  const Approach back = first == Approach::forward ? Approach::reverse : Approach::forward;
  const ApproachVariances own = approach_variances(moving, points, grid, first);
  const ApproachVariances other = approach_variances(moving, points, grid, back);
  // Weight of the approach `first` in the mean of both approaches at a target.
  const auto share = [&](std::size_t j) { return !own.has[j] ? 0 : other.has[j] ? 0.5 : 1.0; };
  const Errors5 apart = half_difference(moving, points);
  const MissingVisitEffects shared(moving, points, grid, own.u_visit);
  SeriesOfErrors u;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    u[k].assign(grid.size(), kNaN);
    const auto own_shifts = shared.of(first, k), other_shifts = shared.of(back, k);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!own.has[i] && !(is_mean && other.has[i])) continue;
      const double by_first = is_mean ? share(i) : 1;
      const Reference& reference = references[k][i];
      std::vector<double> by_own, by_other;  // weights of the means of each approach in this value
      double variance = 0, referred = 0;
      for (std::size_t j = 0; j < grid.size(); ++j) {
        by_own.push_back((i == j ? by_first : 0) - reference[j] * share(j));
        by_other.push_back((i == j ? 1 - by_first : 0) - reference[j] * (1 - share(j)));
        variance += by_own[j] * by_own[j] * own.variance[j][k] +
                    by_other[j] * by_other[j] * other.variance[j][k];
        referred += reference[j];
      }
      for (std::size_t p = 0; p < own_shifts.size(); ++p) {
        double change = 0;
        for (std::size_t j = 0; j < grid.size(); ++j)
          change += by_own[j] * own_shifts[p][j] + by_other[j] * other_shifts[p][j];
        variance += change * change;
      }
      const bool is_referred = referred > 0.5;
      if (shared.has_levels())
        variance += is_referred ? 0 : shared.run_level(k) * shared.run_level(k);
      else if (is_referred)  // half of the difference of the passes cancels in the mean of both
        variance += by_first == 0.5 ? 0 : apart[k];
      else
        variance +=
            by_first * by_first * own.shift[k] + (1 - by_first) * (1 - by_first) * other.shift[k];
      u[k][i] = std::sqrt(variance);
    }
  }
  return u;
}

}  // namespace mdof::algo
