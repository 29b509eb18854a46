// Calculates the drift of each run relative to the other runs, as a linear function of the errors
// of the visits.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "algo/linear_algebra/least_squares.h"
#include "schema/point.h"

namespace mdof::algo {

// Fits by least squares
//   error = effect of the visit + effect of the run,
//
// where a visit is a target and an approach. The matrix of the fit depends only on the existing
// visits, so it is decomposed once in the constructor; of() may then be called many times.
class RunDrifts {
 public:
  // Requires at least one point.
  explicit RunDrifts(const std::vector<MeasuredPoint>& points);

  // `errors`: errors of each point, in any frame and unit. Returns the drift of each run, in
  // ascending order of the run numbers. For runs that are linked by common visits, the sum of the
  // drifts is 0.
  std::vector<Errors5> of(const std::vector<Errors5>& errors) const;
  // Returns for each point the index of its run.
  const std::vector<std::size_t>& point_runs() const { return run_of_; }

 private:
  struct Entry {
    std::size_t effect, point;
  };
  using Entries = std::vector<Entry>;  // all entries of one run or of one visit

  void decompose(const std::vector<Entries>& shared, std::size_t effects);
  Eigen::MatrixXd effects(const std::vector<Entries>& shared,
                          const std::vector<Errors5>& errors) const;
  void group_linked_runs(std::size_t visits);

  std::vector<std::size_t> run_of_;
  // Entry::effect is a visit in of_run_, and a run in of_visit_.
  std::vector<Entries> of_run_, of_visit_;
  std::vector<std::vector<std::size_t>> linked_runs_;
  bool runs_are_fewer_ = true;
  std::optional<LeastNorm> fit_;
};

}  // namespace mdof::algo
