#include "algo/sequence/uneven_visits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/sequence/ranges_text.h"
#include "algo/sequence/run_drifts.h"

namespace mdof::algo {
namespace {

using Cell = std::pair<int, int>;  // target and direction

Cell cell_of(const MeasuredPoint& p) {
  return {p.target, p.point.direction};
}

std::vector<MeasuredPoint> counted_points(const std::vector<MeasuredPoint>& points) {
  std::vector<MeasuredPoint> out;
  std::copy_if(points.begin(), points.end(), std::back_inserter(out), counts_in_means);
  return out;
}

// Returns the runs that lack a visit which another run has, in ascending order.
std::vector<int> find_incomplete_runs(const std::vector<MeasuredPoint>& points) {
  std::set<Cell> of_all;
  std::map<int, std::set<Cell>> of_run;
  for (const MeasuredPoint& p : points) {
    of_all.insert(cell_of(p));
    of_run[p.run].insert(cell_of(p));
  }
  std::vector<int> lacking;
  for (const auto& [run, cells] : of_run)
    if (cells.size() < of_all.size()) lacking.push_back(run);
  return lacking;
}

struct Approached {
  std::vector<int> one_sided_targets;  // ascending
  bool any_from_both = false;
  std::set<int> directions;
};

Approached approached(const std::vector<MeasuredPoint>& points) {
  std::map<int, std::set<int>> of_target;
  Approached sides;
  for (const MeasuredPoint& p : points) {
    of_target[p.target].insert(p.point.direction);
    sides.directions.insert(p.point.direction);
  }
  for (const auto& [target, directions] : of_target)
    if (directions.size() == 1) sides.one_sided_targets.push_back(target);
  sides.any_from_both = sides.one_sided_targets.size() < of_target.size();
  return sides;
}

}  // namespace

bool counts_in_means(const MeasuredPoint& p) {
  return p.errors.valid && p.point.direction != 0;
}

bool any_run_lacks_visits(const std::vector<MeasuredPoint>& counted) {
  return !find_incomplete_runs(counted).empty();
}

WithoutDrift subtract_run_drifts(const std::vector<MeasuredPoint>& points) {
  WithoutDrift out{counted_points(points), {}};
  if (!any_run_lacks_visits(out.points)) return out;
  const RunDrifts run_drifts(out.points);
  std::vector<Errors5> errors;
  for (const MeasuredPoint& p : out.points) errors.push_back(p.errors.local);
  const std::vector<Errors5> drifts = run_drifts.of(errors);
  for (std::size_t j = 0; j < out.points.size(); ++j)
    for (std::size_t k = 0; k < 5; ++k)
      out.points[j].errors.local[k] -= drifts[run_drifts.point_runs()[j]][k];
  const auto n = static_cast<double>(drifts.size());
  for (std::size_t k = 0; k < 5; ++k) {
    double square = 0;  // squares about 0, because the sum of the drifts is 0
    for (const Errors5& drift : drifts) square += drift[k] * drift[k];
    if (n > 1) out.u_level[k] = std::sqrt(square / (n - 1) / n);
  }
  return out;
}

Notices uneven_visits(const std::vector<MeasuredPoint>& points) {
  const auto counted = counted_points(points);
  const auto lacking = find_incomplete_runs(counted);
  const Approached from = approached(counted);
  const auto& one_sided = from.one_sided_targets;
  Notices found;
  if (!lacking.empty())
    found.push_back(notice(NoticeCode::run_lacks_visits, "", {{"runs", numbered("run", lacking)}}));
  if (one_sided.empty() || from.directions.size() == 1) return found;
  found.push_back(from.any_from_both ? notice(NoticeCode::target_from_one_side, "",
                                              {{"targets", numbered("target", one_sided)}})
                                     : notice(NoticeCode::approaches_mixed));
  return found;
}

}  // namespace mdof::algo
