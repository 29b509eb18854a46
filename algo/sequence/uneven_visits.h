// Handles missing visits of a run, and targets that were approached from one side only, in the
// calculation of means of both approaches.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

// Returns whether means use this point: its errors are valid and its approach is known.
bool counts_in_means(const MeasuredPoint& point);
// Returns whether a run lacks a visit that another run has. `counted`: points for which
// counts_in_means() is true.
bool any_run_lacks_visits(const std::vector<MeasuredPoint>& counted);

struct WithoutDrift {
  std::vector<MeasuredPoint> points;
  Errors5 u_level{};  // local errors; m, rad
};
// Returns the valid points with a known approach in the same order. A visit is a target and an
// approach. If a run lacks a visit that another run has, the means of different targets contain
// different runs, so drifts between the runs would change the slope of the result. Then the mean
// drift of each run relative to the other runs is subtracted from its errors (run_drifts.h); the
// sum of the drifts is 0. u_level is s/√n of the n drifts, with their standard deviation s. It is
// the uncertainty of the level that all targets have in common, whatever the number of runs at a
// target is. It is 0 if nothing was subtracted.
WithoutDrift subtract_run_drifts(const std::vector<MeasuredPoint>& points);

// Returns notices about missing visits and targets with one approach: which of them the means take
// into account, and which they cannot take into account.
Notices uneven_visits(const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
