#include "algo/sequence/uneven_visits.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "algo/linear_algebra/least_squares.h"
#include "algo/points/ranges_text.h"

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

// Least squares of error = effect of one kind + effect of another, by the normal equations with the
// second kind eliminated: one row and column for each effect of the first.
class EffectFit {
 public:
  struct Entry {
    Eigen::Index effect;  // of the first kind
    const Errors5* errors;
  };
  using Entries = std::vector<Entry>;  // those that share an effect of the second kind

  explicit EffectFit(std::size_t effects)
      : normal_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(effects),
                                      static_cast<Eigen::Index>(effects))),
        right_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(effects), 5)) {}

  void add(const Entries& shared) {
    const double share = 1 / static_cast<double>(shared.size());
    Errors5 mean{};
    for (const Entry& e : shared)
      for (std::size_t k = 0; k < 5; ++k) mean[k] += share * (*e.errors)[k];
    for (const Entry& e : shared) {
      normal_(e.effect, e.effect) += 1;
      for (const Entry& other : shared) normal_(e.effect, other.effect) -= share;
      for (std::size_t k = 0; k < 5; ++k)
        right_(e.effect, static_cast<Eigen::Index>(k)) += (*e.errors)[k] - mean[k];
    }
  }

  // Of the first kind, [effect][error]. Effects that no entries link have no difference; the
  // solution of least norm leaves them as they are.
  Eigen::MatrixXd solve() const { return LeastNorm(normal_).solve(right_); }

 private:
  Eigen::MatrixXd normal_, right_;
};

using Drifts = std::map<int, Errors5>;  // of each run

template <class Key>
std::map<Key, Eigen::Index> numbered_effects(const std::map<Key, EffectFit::Entries>& by_key) {
  std::map<Key, Eigen::Index> index;
  for (const auto& [key, entries] : by_key)
    index.emplace_hint(index.end(), key, static_cast<Eigen::Index>(index.size()));
  return index;
}

// The groups of visits that are linked by runs with both; each is named by its lowest visit.
class Links {
 public:
  explicit Links(Eigen::Index effects) {
    for (Eigen::Index i = 0; i < effects; ++i) lowest_.push_back(i);
  }
  void link(Eigen::Index a, Eigen::Index b) {
    a = lowest(a);
    b = lowest(b);
    lowest_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  Eigen::Index lowest(Eigen::Index i) const {
    while (lowest_[static_cast<std::size_t>(i)] != i) i = lowest_[static_cast<std::size_t>(i)];
    return i;
  }

 private:
  std::vector<Eigen::Index> lowest_;
};

class RunFit {
 public:
  explicit RunFit(const std::vector<MeasuredPoint>& points) {
    for (const MeasuredPoint& p : points) {
      of_run_[p.run];
      of_cell_[cell_of(p)];
    }
    runs_ = numbered_effects(of_run_);
    cells_ = numbered_effects(of_cell_);
    for (const MeasuredPoint& p : points) {
      of_run_[p.run].push_back({cells_.at(cell_of(p)), &p.errors.local});
      of_cell_[cell_of(p)].push_back({runs_.at(p.run), &p.errors.local});
    }
  }

  // Whichever are fewer are solved for, as that takes the cube of their number.
  Drifts drifts() const { return runs_.size() <= cells_.size() ? solved() : of_visits_solved(); }

 private:
  Drifts solved() const {
    EffectFit fit(runs_.size());
    for (const auto& [cell, entries] : of_cell_) fit.add(entries);
    const Eigen::MatrixXd solved = fit.solve();
    Drifts drifts;
    for (const auto& [run, row] : runs_)
      for (Eigen::Index k = 0; k < 5; ++k)
        drifts[run][static_cast<std::size_t>(k)] = solved(row, k);
    return drifts;
  }

  // A run's drift is the mean of what its visits leave of its errors.
  Drifts of_visits_solved() const {
    EffectFit fit(cells_.size());
    for (const auto& [run, entries] : of_run_) fit.add(entries);
    const Eigen::MatrixXd visits = fit.solve();
    Drifts drifts;
    for (const auto& [run, entries] : of_run_)
      for (const EffectFit::Entry& e : entries)
        for (std::size_t k = 0; k < 5; ++k)
          drifts[run][k] += ((*e.errors)[k] - visits(e.effect, static_cast<Eigen::Index>(k))) /
                            static_cast<double>(entries.size());
    return summed_to_zero(std::move(drifts));
  }

  // Those of each group of runs that visits link.
  Drifts summed_to_zero(Drifts drifts) const {
    Links links(static_cast<Eigen::Index>(cells_.size()));
    for (const auto& [run, entries] : of_run_)
      for (const EffectFit::Entry& e : entries) links.link(entries[0].effect, e.effect);
    std::map<Eigen::Index, Drifts> groups;
    for (const auto& [run, drift] : drifts)
      groups[links.lowest(of_run_.at(run)[0].effect)][run] = drift;
    for (const auto& [lowest, group] : groups) {
      Errors5 mean{};
      for (const auto& [run, drift] : group)
        for (std::size_t k = 0; k < 5; ++k) mean[k] += drift[k] / static_cast<double>(group.size());
      for (const auto& [run, drift] : group)
        for (std::size_t k = 0; k < 5; ++k) drifts[run][k] -= mean[k];
    }
    return drifts;
  }

  std::map<int, EffectFit::Entries> of_run_;    // their effects are of cells_
  std::map<Cell, EffectFit::Entries> of_cell_;  // of runs_
  std::map<int, Eigen::Index> runs_;
  std::map<Cell, Eigen::Index> cells_;
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
