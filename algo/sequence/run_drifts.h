// The drift of each run relative to the others, as a linear function of the errors of their visits.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "algo/linear_algebra/least_squares.h"
#include "schema/point.h"

namespace mdof::algo {

// Solves the least-squares fit error = effect of the visit (a target from one side) + effect of the
// run. Its matrix depends only on which visits exist, so it is prepared once for any number of
// errors.
class RunDrifts {
 public:
  // Requires at least one point.
  explicit RunDrifts(const std::vector<MeasuredPoint>& points);

  // `errors`: of each point, in any frame and unit. Returns the drift of each run, in ascending
  // order of the run numbers. The drifts of runs that are linked by visits sum to 0.
  std::vector<Errors5> of(const std::vector<Errors5>& errors) const;
  // The index of each point's run.
  const std::vector<std::size_t>& point_runs() const { return run_of_; }

 private:
  struct Entry {
    std::size_t effect, point;
  };
  using Entries = std::vector<Entry>;  // entries that share an effect of the other kind

  void decompose(const std::vector<Entries>& shared, std::size_t effects);
  Eigen::MatrixXd effects(const std::vector<Entries>& shared,
                          const std::vector<Errors5>& errors) const;
  void group_linked_runs(std::size_t visits);

  std::vector<std::size_t> run_of_;
  std::vector<Entries> of_run_, of_visit_;  // their effects are visits and runs
  std::vector<std::vector<std::size_t>> linked_runs_;
  bool runs_are_fewer_ = true;
  std::optional<LeastNorm> fit_;
};

}  // namespace mdof::algo
