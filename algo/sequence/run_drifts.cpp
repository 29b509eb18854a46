#include "algo/sequence/run_drifts.h"

#include <algorithm>
#include <map>
#include <utility>

namespace mdof::algo {
namespace {

Eigen::Index at(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

// Sets the value of each key to its index in ascending order.
template <class Key>
void number(std::map<Key, std::size_t>& keys) {
  std::size_t next = 0;
  for (auto& [key, n] : keys) n = next++;
}

// Groups of visits that are linked by common runs. The lowest visit identifies a group.
class Links {
 public:
  explicit Links(std::size_t visits) {
    for (std::size_t i = 0; i < visits; ++i) lowest_.push_back(i);
  }
  void link(std::size_t a, std::size_t b) {
    a = lowest(a);
    b = lowest(b);
    lowest_[std::max(a, b)] = std::min(a, b);
  }
  std::size_t lowest(std::size_t i) const {
    while (lowest_[i] != i) i = lowest_[i];
    return i;
  }

 private:
  std::vector<std::size_t> lowest_;
};

}  // namespace

RunDrifts::RunDrifts(const std::vector<MeasuredPoint>& points) {
  std::map<int, std::size_t> runs;
  std::map<std::pair<int, int>, std::size_t> visits;  // target and direction
  for (const MeasuredPoint& p : points) {
    runs[p.run];
    visits[{p.target, p.point.direction}];
  }
  number(runs);
  number(visits);
  of_run_.resize(runs.size());
  of_visit_.resize(visits.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    const std::size_t run = runs.at(points[j].run);
    const std::size_t visit = visits.at({points[j].target, points[j].point.direction});
    run_of_.push_back(run);
    of_run_[run].push_back({visit, j});
    of_visit_[visit].push_back({run, j});
  }
  // Solves for the effects of the runs or of the visits, whichever are fewer, because the
  // calculation time grows with the cube of their number.
  runs_are_fewer_ = runs.size() <= visits.size();
  runs_are_fewer_ ? decompose(of_visit_, runs.size()) : decompose(of_run_, visits.size());
  group_linked_runs(visits.size());
}

// Decomposes the normal equations after elimination of the effects of the other kind (runs or
// visits). The matrix has one row and one column for each remaining effect.
void RunDrifts::decompose(const std::vector<Entries>& shared, std::size_t effects) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(at(effects), at(effects));
  for (const Entries& entries : shared) {
    const double share = 1 / static_cast<double>(entries.size());
    for (const Entry& e : entries) {
      normal(at(e.effect), at(e.effect)) += 1;
      for (const Entry& other : entries) normal(at(e.effect), at(other.effect)) -= share;
    }
  }
  fit_.emplace(normal);
}

// Returns the solved effects as [effect][error]. Differences between effects that are not linked by
// entries are not determined; the solution with the smallest norm is used.
Eigen::MatrixXd RunDrifts::effects(const std::vector<Entries>& shared,
                                   const std::vector<Errors5>& errors) const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(fit_->unknowns(), kErrorCount);
  for (const Entries& entries : shared) {
    const double share = 1 / static_cast<double>(entries.size());
    Errors5 mean{};
    for (const Entry& e : entries)
      for (std::size_t k = 0; k < kErrorCount; ++k) mean[k] += share * errors[e.point][k];
    for (const Entry& e : entries)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        right(at(e.effect), at(k)) += errors[e.point][k] - mean[k];
  }
  return fit_->solve(right);
}

void RunDrifts::group_linked_runs(std::size_t visits) {
  Links links(visits);
  for (const Entries& entries : of_run_)
    for (const Entry& e : entries) links.link(entries[0].effect, e.effect);
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t run = 0; run < of_run_.size(); ++run)
    groups[links.lowest(of_run_[run][0].effect)].push_back(run);
  for (auto& [lowest, runs] : groups) linked_runs_.push_back(std::move(runs));
}

std::vector<Errors5> RunDrifts::of(const std::vector<Errors5>& errors) const {
  std::vector<Errors5> drifts(of_run_.size(), Errors5{});
  if (runs_are_fewer_) {
    const Eigen::MatrixXd solved = effects(of_visit_, errors);
    for (std::size_t run = 0; run < drifts.size(); ++run)
      for (std::size_t k = 0; k < kErrorCount; ++k) drifts[run][k] = solved(at(run), at(k));
    return drifts;
  }
  // The drift of a run is the mean difference between its errors and the effects of its visits.
  const Eigen::MatrixXd visits = effects(of_run_, errors);
  for (std::size_t run = 0; run < drifts.size(); ++run)
    for (const Entry& e : of_run_[run])
      for (std::size_t k = 0; k < kErrorCount; ++k)
        drifts[run][k] += (errors[e.point][k] - visits(at(e.effect), at(k))) /
                          static_cast<double>(of_run_[run].size());
  for (const auto& runs : linked_runs_) {
    Errors5 mean{};
    for (const std::size_t run : runs)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        mean[k] += drifts[run][k] / static_cast<double>(runs.size());
    for (const std::size_t run : runs)
      for (std::size_t k = 0; k < kErrorCount; ++k) drifts[run][k] -= mean[k];
  }
  return drifts;
}

}  // namespace mdof::algo
