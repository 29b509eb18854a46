#include "algo/uneven_visits.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/ranges_text.h"

namespace mdof::algo {
namespace {

using Cell = std::pair<int, int>;  // target and direction

Cell cell_of(const MeasuredPoint& p) {
  return {p.target, p.point.direction};
}

std::vector<MeasuredPoint> that_count(const std::vector<MeasuredPoint>& points) {
  std::vector<MeasuredPoint> out;
  std::copy_if(points.begin(), points.end(), std::back_inserter(out),
               [](const auto& p) { return p.errors.valid && p.point.direction != 0; });
  return out;
}

// Ascending.
std::vector<int> runs_that_lack_visits(const std::vector<MeasuredPoint>& points) {
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
  std::vector<int> targets_from_one;  // ascending
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
    if (directions.size() == 1) sides.targets_from_one.push_back(target);
  sides.any_from_both = sides.targets_from_one.size() < of_target.size();
  return sides;
}

// The normal equations of the fit, with the visits eliminated: one row and column a run. Runs that
// share no visit have no difference; the solution of least norm leaves them as they are.
class RunFit {
 public:
  explicit RunFit(const std::vector<MeasuredPoint>& points) {
    for (const MeasuredPoint& p : points) rows_.try_emplace(p.run, 0);
    Eigen::Index row = 0;
    for (auto& [run, index] : rows_) index = row++;
    for (const MeasuredPoint& p : points) visits_[cell_of(p)].push_back(&p);
  }

  std::map<int, Errors5> drifts() const {
    const auto n = static_cast<Eigen::Index>(rows_.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n), right = Eigen::MatrixXd::Zero(n, 5);
    for (const auto& [cell, visits] : visits_) add(visits, normal, right);
    const Eigen::MatrixXd solved = normal.completeOrthogonalDecomposition().solve(right);
    std::map<int, Errors5> drifts;
    for (const auto& [run, row] : rows_)
      for (Eigen::Index k = 0; k < 5; ++k)
        drifts[run][static_cast<std::size_t>(k)] = solved(row, k);
    return drifts;
  }

 private:
  using Visits = std::vector<const MeasuredPoint*>;

  void add(const Visits& visits, Eigen::MatrixXd& normal, Eigen::MatrixXd& right) const {
    const double share = 1 / static_cast<double>(visits.size());
    for (const MeasuredPoint* p : visits) {
      const Eigen::Index row = rows_.at(p->run);
      normal(row, row) += 1;
      for (const MeasuredPoint* other : visits) normal(row, rows_.at(other->run)) -= share;
      for (std::size_t k = 0; k < 5; ++k) {
        double mean = 0;
        for (const MeasuredPoint* other : visits) mean += share * other->errors.local[k];
        right(row, static_cast<Eigen::Index>(k)) += p->errors.local[k] - mean;
      }
    }
  }

  std::map<int, Eigen::Index> rows_;  // by run
  std::map<Cell, Visits> visits_;
};

}  // namespace

WithoutDrift without_drift_of_runs(const std::vector<MeasuredPoint>& points) {
  WithoutDrift out{that_count(points), {}};
  if (runs_that_lack_visits(out.points).empty()) return out;
  const auto drifts = RunFit(out.points).drifts();
  for (MeasuredPoint& p : out.points)
    for (std::size_t k = 0; k < 5; ++k) p.errors.local[k] -= drifts.at(p.run)[k];
  const auto n = static_cast<double>(drifts.size());
  for (std::size_t k = 0; k < 5; ++k) {
    double square = 0;  // the drifts sum to 0
    for (const auto& [run, drift] : drifts) square += drift[k] * drift[k];
    if (n > 1) out.u_level[k] = std::sqrt(square / (n - 1) / n);
  }
  return out;
}

std::string uneven_visits_text(const std::vector<MeasuredPoint>& points) {
  const auto counted = that_count(points);
  const auto lacking = runs_that_lack_visits(counted);
  const Approached from = approached(counted);
  const auto& one_sided = from.targets_from_one;
  std::string text;
  if (!lacking.empty())
    text = numbered("run", lacking) + " lack" + (lacking.size() == 1 ? "s" : "") +
           " visits that others have: means, slopes and squareness are made without the drift "
           "between the runs";
  if (one_sided.empty() || from.directions.size() == 1) return text;
  if (!text.empty()) text += "; ";
  if (!from.any_from_both)
    return text +
           "no target was approached from both sides, and not all from the same one: half a "
           "reversal error is in slopes and squareness, and not in their u; measure again";
  return text + numbered("target", one_sided) + (one_sided.size() == 1 ? " was" : " were") +
         " approached from one side only: means of both approaches, slopes and squareness take "
         "the missing approach from the mean reversal of the other targets";
}

}  // namespace mdof::algo
