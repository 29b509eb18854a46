// Variance of one visit, calculated from repeated visits of the targets of a run.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

class VisitScatter {
 public:
  // Uses only the points that are used in means (uneven_visits.h).
  explicit VisitScatter(const std::vector<MeasuredPoint>& points);

  bool has_repeats() const {
    return freedom_ > 0;
  }  // at least one target has several visits with
     // the same approach
  bool are_single() const { return !visits_.empty() && !has_repeats(); }

  // Variance of one visit and its degrees of freedom; 0 without repeated visits.
  struct Pooled {
    Errors5 variance{}, freedom{};
  };
  // `values`: one for each point of the run. The variance is pooled over all targets and
  // approaches. The part of the variance that all targets of a pass have in common has only the
  // degrees of freedom of the passes. The degrees of freedom of both parts are combined by
  // Welch-Satterthwaite.
  Pooled of(const std::vector<Errors5>& values) const;
  // As of(), after removal of a least-squares change in proportion to time. `time_s`: one for each
  // point.
  Pooled without_trend(const std::vector<Errors5>& values, const std::vector<double>& time_s) const;

 private:
  // `taken`: number of parameters that were fitted before.
  Pooled pooled(const std::vector<Errors5>& values, double taken) const;

  struct Visit {
    std::size_t point = 0, place = 0, pass = 0;  // place: target and approach
  };
  std::vector<Visit> visits_;
  std::vector<double> visits_of_place_, pass_visits_;
  double freedom_ = 0, pass_freedom_ = 0;
};

}  // namespace mdof::algo
