// Runs that lack visits which others have, and targets that were approached from one side only:
// what a mean of both approaches does about them.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

// Means are made of the points with errors and a known approach.
bool counts_in_means(const MeasuredPoint& point);
// Of points that count.
bool any_run_lacks_visits(const std::vector<MeasuredPoint>& counted);

struct WithoutDrift {
  std::vector<MeasuredPoint> points;
  Errors5 u_level{};  // local; m, rad
};
// The valid points with a known approach, in their order. Where a run lacks a visit (a target from
// one side) that another run has, each run's mean drift against the others is taken from its
// errors: the mean of some targets only would hold it, and be tilted by it. The drifts are those of
// the least-squares fit error = of the visit + of the run; they sum to 0. Their scatter, s/√n, is
// the uncertainty of the level that all targets then have, however few runs visited them; 0 where
// nothing was taken.
WithoutDrift without_drift_of_runs(const std::vector<MeasuredPoint>& points);

// What the means make up for, and what they cannot.
Notices uneven_visits(const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
