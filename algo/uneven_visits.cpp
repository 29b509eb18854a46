#include "algo/uneven_visits.h"

#include <Eigen/Dense>
#include <algorithm>
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

std::vector<int> one_sided_targets(const std::vector<MeasuredPoint>& points) {
  std::map<int, std::set<int>> sides;
  for (const MeasuredPoint& p : points) sides[p.target].insert(p.point.direction);
  std::vector<int> one_sided;
  for (const auto& [target, directions] : sides)
    if (directions.size() == 1) one_sided.push_back(target);
  if (one_sided.size() == sides.size()) one_sided.clear();  // nothing is known of the reversal
  return one_sided;
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

std::string name_of(const char* what, const std::vector<int>& numbers) {
  return what + std::string(numbers.size() == 1 ? " " : "s ") + ranges_text(numbers);
}

}  // namespace

std::vector<MeasuredPoint> without_drift_of_runs(const std::vector<MeasuredPoint>& points) {
  std::vector<MeasuredPoint> out = that_count(points);
  if (runs_that_lack_visits(out).empty()) return out;
  const auto drifts = RunFit(out).drifts();
  for (MeasuredPoint& p : out)
    for (std::size_t k = 0; k < 5; ++k) p.errors.local[k] -= drifts.at(p.run)[k];
  return out;
}

std::string uneven_visits_text(const std::vector<MeasuredPoint>& points) {
  const auto counted = that_count(points);
  const auto lacking = runs_that_lack_visits(counted), one_sided = one_sided_targets(counted);
  std::string text;
  if (!lacking.empty())
    text = name_of("run", lacking) + " lack" + (lacking.size() == 1 ? "s" : "") +
           " visits that others have: means of both approaches, slopes and squareness are made "
           "without the drift between the runs";
  if (one_sided.empty()) return text;
  return text + (text.empty() ? "" : "; ") + name_of("target", one_sided) +
         (one_sided.size() == 1 ? " was" : " were") +
         " approached from one side only: means of both approaches, slopes and squareness take the "
         "missing approach from the mean reversal of the other targets";
}

}  // namespace mdof::algo
