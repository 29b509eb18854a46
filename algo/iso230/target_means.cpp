#include "algo/iso230/target_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "algo/iso230/line_fit.h"
#include "algo/sequence/uneven_visits.h"

namespace mdof::algo {
namespace {

TargetMean mean_of(const MovingAxis& moving, const std::vector<const MeasuredPoint*>& points) {
  TargetMean mean;
  mean.n = points.size();
  const auto n = static_cast<double>(points.size());
  std::vector<Errors5> named;
  Errors5 noise2{};
  for (const MeasuredPoint* p : points) {
    mean.position_m += p->point.position_m / n;
    named.push_back(named_from_local(moving, p->errors.local));
    const Covariance5 cov = named_from_local(moving.axis, p->errors.covariance);
    for (std::size_t k = 0; k < 5; ++k) noise2[k] += cov[6 * k];
  }
  for (std::size_t k = 0; k < 5; ++k) {
    double sum = 0;
    for (const Errors5& e : named) sum += e[k];
    mean.named[k] = sum / n;
    double square = 0;
    for (const Errors5& e : named) square += (e[k] - mean.named[k]) * (e[k] - mean.named[k]);
    const double scatter = points.size() > 1 ? std::sqrt(square / (n - 1) / n) : 0.0;
    mean.u[k] = std::max(scatter, std::sqrt(noise2[k]) / n);
  }
  return mean;
}

TargetMean mean_of(const TargetMean& forward, const TargetMean& reverse) {
  TargetMean mean;
  mean.n = forward.n + reverse.n;
  mean.position_m = 0.5 * (forward.position_m + reverse.position_m);
  for (std::size_t k = 0; k < 5; ++k) {
    mean.named[k] = 0.5 * (forward.named[k] + reverse.named[k]);
    mean.u[k] = 0.5 * std::sqrt(forward.u[k] * forward.u[k] + reverse.u[k] * reverse.u[k]);
  }
  return mean;
}

// Returns s/√n of the means of both directions at this target, with one mean for each of n runs; 0
// for fewer than two runs. Slow changes shift both directions of a run equally, so the mean of both
// directions does not reduce their effect.
Errors5 scatter_of_runs(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                        int target) {
  std::map<int, std::array<std::vector<Errors5>, 2>> runs;
  for (const auto& p : points) {
    if (!p.errors.valid || p.target != target || p.point.direction == 0) continue;
    runs[p.run][p.point.direction > 0 ? 0 : 1].push_back(named_from_local(moving, p.errors.local));
  }
  Errors5 u{};
  for (std::size_t k = 0; k < 5; ++k) {
    double n = 0, mean = 0, square = 0;
    for (const auto& [run, ways] : runs) {
      if (ways[0].empty() || ways[1].empty()) continue;
      const double of_run = 0.5 * (ways[0].front()[k] + ways[1].front()[k]);
      n += 1;
      const double off = of_run - mean;
      mean += off / n;
      square += off * (of_run - mean);
    }
    if (n > 1) u[k] = std::sqrt(square / (n - 1) / n);
  }
  return u;
}

using MeansByTarget = std::map<int, TargetMean>;

MeansByTarget one_way(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                      int direction) {
  std::map<int, std::vector<const MeasuredPoint*>> groups;
  for (const auto& p : points) {
    if (p.errors.valid && p.point.direction == direction) groups[p.target].push_back(&p);
  }
  MeansByTarget means;
  for (const auto& [target, group] : groups) means[target] = mean_of(moving, group);
  return means;
}

// Forward minus reverse at the targets that have both approaches.
struct Reversal {
  Errors5 mean{};
  // u of the reversal of a single target for which the mean is used. If only one target has both
  // approaches, u is the absolute value of its reversal.
  Errors5 u{};
  double position_m = 0;  // mean position of these targets
  Errors5 slope{};        // per m of encoder position; 0 if not significant
  double trend(std::size_t k, double at_m) const { return slope[k] * (at_m - position_m); }
};

Reversal mean_reversal(const MeansByTarget& forward, const MeansByTarget& reverse) {
  std::vector<Errors5> at_targets;
  std::vector<double> positions_m;
  for (const auto& [target, f] : forward) {
    const auto r = reverse.find(target);
    if (r == reverse.end()) continue;
    positions_m.push_back(0.5 * (f.position_m + r->second.position_m));
    Errors5& difference = at_targets.emplace_back();
    for (std::size_t k = 0; k < 5; ++k) difference[k] = f.named[k] - r->second.named[k];
  }
  Reversal out;
  const auto n = static_cast<double>(at_targets.size());
  if (at_targets.empty()) return out;
  for (const double x : positions_m) out.position_m += x / n;
  for (std::size_t k = 0; k < 5; ++k) {
    std::vector<double> of_error;
    for (const Errors5& r : at_targets) of_error.push_back(r[k]);
    const Line line = can_fit(positions_m) ? least_squares_line(positions_m, of_error) : Line{};
    if (std::abs(line.slope) > 2 * line.u_slope) out.slope[k] = line.slope;
    double sum = 0, square = 0;
    for (const Errors5& r : at_targets) sum += r[k];
    out.mean[k] = sum / n;
    for (const Errors5& r : at_targets) square += (r[k] - out.mean[k]) * (r[k] - out.mean[k]);
    out.u[k] = n > 1 ? std::sqrt(square / (n - 1) * (1 + 1 / n)) : std::abs(out.mean[k]);
  }
  return out;
}

TargetMean with_reversal(TargetMean one_sided, const Reversal& reversal, int direction) {
  for (std::size_t k = 0; k < 5; ++k) {
    one_sided.named[k] -= 0.5 * direction * reversal.mean[k];
    one_sided.u_trend[k] = 0.5 * direction * reversal.trend(k, one_sided.position_m);
    one_sided.u[k] = std::hypot(one_sided.u[k], 0.5 * reversal.u[k], one_sided.u_trend[k]);
  }
  return one_sided;
}

MeansByTarget both_ways(const MovingAxis& moving, const std::vector<MeasuredPoint>& points) {
  const MeansByTarget forward = one_way(moving, points, 1), reverse = one_way(moving, points, -1);
  const Reversal reversal = mean_reversal(forward, reverse);
  MeansByTarget means;
  for (const auto& [target, f] : forward) {
    const auto r = reverse.find(target);
    means[target] = r != reverse.end() ? mean_of(f, r->second) : with_reversal(f, reversal, 1);
    if (r == reverse.end()) continue;
    const Errors5 of_runs = scatter_of_runs(moving, points, target);
    for (std::size_t k = 0; k < 5; ++k)
      means[target].u[k] = std::max(means[target].u[k], of_runs[k]);
  }
  for (const auto& [target, r] : reverse)
    if (!forward.contains(target)) means[target] = with_reversal(r, reversal, -1);
  return means;
}

MeansByTarget means_of(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                       Approach approach) {
  return approach == Approach::both
             ? both_ways(moving, points)
             : one_way(moving, points, approach == Approach::forward ? 1 : -1);
}

}  // namespace

const char* to_string(Approach approach) {
  return approach == Approach::forward   ? "forward"
         : approach == Approach::reverse ? "reverse"
                                         : "mean";
}

std::vector<TargetMean> target_means(const MovingAxis& moving,
                                     const std::vector<MeasuredPoint>& points, Approach approach) {
  const WithoutDrift without = subtract_run_drifts(points);
  const Errors5 u_level = named_from_local(moving, without.u_level);
  MeansByTarget means = means_of(moving, without.points, approach);
  for (const auto& [target, drifting] : means_of(moving, points, approach))
    for (std::size_t k = 0; k < 5; ++k)
      means[target].u[k] = std::max({means[target].u[k], drifting.u[k], std::abs(u_level[k])});
  std::vector<TargetMean> ascending;
  for (auto& [target, mean] : means) {
    mean.target = target;
    ascending.push_back(mean);
  }
  return ascending;
}

std::vector<double> positions(const std::vector<TargetMean>& means) {
  std::vector<double> x;
  for (const TargetMean& m : means) x.push_back(m.position_m);
  return x;
}

std::vector<double> own_travels(const Sides& sides, const std::vector<TargetMean>& means) {
  std::vector<double> x;
  x.reserve(means.size());
  for (const TargetMean& m : means) x.push_back(sides.moving_body_travel_m(m.position_m));
  return x;
}

std::vector<double> column(const std::vector<TargetMean>& means, std::size_t named) {
  std::vector<double> y;
  y.reserve(means.size());
  for (const TargetMean& m : means) y.push_back(m.named[named]);
  return y;
}

}  // namespace mdof::algo
