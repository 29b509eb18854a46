// Variance of a single visit, from repeated visits of a run's targets.
#pragma once

#include <cstddef>
#include <vector>

#include "schema/point.h"

namespace mdof::algo {

class VisitScatter {
 public:
  // Uses the points that count in means (uneven_visits.h).
  explicit VisitScatter(const std::vector<MeasuredPoint>& points);

  bool has_repeats() const { return freedom_ > 0; }  // a target was revisited from the same side
  bool are_single() const { return !visits_.empty() && !has_repeats(); }

  // Variance of a visit and its degrees of freedom; 0 without repeats.
  struct Pooled {
    Errors5 variance{}, freedom{};
  };
  // `values`: of each point of the run. The variance is pooled over the visits of each target from
  // each side. The part that all targets of a pass share has only the degrees of freedom of the
  // passes; both parts add by Welch-Satterthwaite.
  Pooled of(const std::vector<Errors5>& values) const;
  // The same, after a change in proportion to time is removed by least squares. `time_s`: of each
  // point.
  Pooled without_trend(const std::vector<Errors5>& values, const std::vector<double>& time_s) const;

 private:
  // `taken`: number of fitted degrees of freedom.
  Pooled pooled(const std::vector<Errors5>& values, double taken) const;

  struct Visit {
    std::size_t point = 0, place = 0, pass = 0;  // place: a target from one side
  };
  std::vector<Visit> visits_;
  std::vector<double> visits_of_place_, pass_visits_;
  double freedom_ = 0, pass_freedom_ = 0;
};

}  // namespace mdof::algo
