#include "algo/uncertainty/statistics/visit_scatter.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/coverage.h"

namespace mdof::algo {
namespace {

using Numbers = std::map<std::pair<int, int>, std::size_t>;

// Returns the index of a group, starting at 0, and increases the number of its members by 1.
std::size_t number_of(std::pair<int, int> group, Numbers& numbers, std::vector<double>& members) {
  const auto [at, is_new] = numbers.emplace(group, numbers.size());
  if (is_new) members.push_back(0);
  members[at->second] += 1;
  return at->second;
}

}  // namespace

VisitScatter::VisitScatter(const std::vector<MeasuredPoint>& points) {
  Numbers places, passes;
  std::set<int> sides;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MeasuredPoint& p = points[i];
    if (!counts_in_means(p)) continue;
    const int side = p.point.direction > 0 ? 1 : -1;
    sides.insert(side);
    visits_.push_back({i, number_of({p.target, side}, places, visits_of_place_),
                       number_of({p.run, side}, passes, pass_visits_)});
  }
  freedom_ = static_cast<double>(visits_.size() - places.size());
  pass_freedom_ = std::min(freedom_, static_cast<double>(passes.size() - sides.size()));
}

VisitScatter::Pooled VisitScatter::of(const std::vector<Errors5>& values) const {
  return pooled(values, 0);
}

VisitScatter::Pooled VisitScatter::without_trend(const std::vector<Errors5>& values,
                                                 const std::vector<double>& time_s) const {
  if (freedom_ < 2) return of(values);
  std::vector<double> middle_s(visits_of_place_.size());
  for (const Visit& visit : visits_)
    middle_s[visit.place] += time_s[visit.point] / visits_of_place_[visit.place];
  double square = 0;
  Errors5 product{};
  for (const Visit& visit : visits_) {
    const double off_s = time_s[visit.point] - middle_s[visit.place];
    square += off_s * off_s;
    for (std::size_t k = 0; k < kErrorCount; ++k) product[k] += off_s * values[visit.point][k];
  }
  if (!(square > 0)) return of(values);
  std::vector<Errors5> steady = values;
  for (const Visit& visit : visits_)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      steady[visit.point][k] -= product[k] / square * (time_s[visit.point] - middle_s[visit.place]);
  return pooled(steady, 1);
}

VisitScatter::Pooled VisitScatter::pooled(const std::vector<Errors5>& values, double taken) const {
  Pooled pooled;
  if (!has_repeats()) return pooled;
  const double freedom = freedom_ - taken;
  const double freedom_of_passes = std::max(0.0, pass_freedom_ - taken);
  std::vector<Errors5> of_place(visits_of_place_.size()), of_pass(pass_visits_.size());
  for (const Visit& visit : visits_)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      of_place[visit.place][k] += values[visit.point][k] / visits_of_place_[visit.place];
  Errors5 all{}, shared{};  // sums of squares
  for (const Visit& visit : visits_)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double off = values[visit.point][k] - of_place[visit.place][k];
      all[k] += off * off;
      of_pass[visit.pass][k] += off / pass_visits_[visit.pass];
    }
  for (std::size_t p = 0; p < of_pass.size(); ++p)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      shared[k] += pass_visits_[p] * of_pass[p][k] * of_pass[p][k];
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const double of_passes = std::min(shared[k], all[k]);
    pooled.variance[k] = all[k] / freedom;
    double fourths = 0;
    if (freedom_of_passes > 0)
      fourths += fourth_over_freedom(of_passes / freedom, freedom_of_passes);
    if (freedom > freedom_of_passes)
      fourths += fourth_over_freedom((all[k] - of_passes) / freedom, freedom - freedom_of_passes);
    // If the passes have all degrees of freedom, no degrees of freedom remain for the scatter
    // within the passes.
    pooled.freedom[k] = std::min(freedom, effective_freedom(pooled.variance[k], fourths));
  }
  return pooled;
}

}  // namespace mdof::algo
