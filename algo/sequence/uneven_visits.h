// Runs that lack visits which others have, and targets that were approached from one side only, and
// how a mean of both approaches takes them into account.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::algo {

// Means use the points with errors and a known approach.
bool counts_in_means(const MeasuredPoint& point);
// `counted`: points for which counts_in_means() holds.
bool any_run_lacks_visits(const std::vector<MeasuredPoint>& counted);

struct WithoutDrift {
  std::vector<MeasuredPoint> points;
  Errors5 u_level{};  // local; m, rad
};
// The valid points with a known approach, in their order. If a run lacks a visit (a target from one
// side) that another run has, the mean drift of each run relative to the others is subtracted from
// its errors; otherwise the means of some targets would contain it and tilt the result. The drifts
// are from the least-squares fit error = effect of the visit + effect of the run; they sum to 0.
// u_level is their scatter, s/√n: the uncertainty of the common level of all targets, for any
// number of runs that visited them; 0 if nothing was subtracted.
WithoutDrift subtract_run_drifts(const std::vector<MeasuredPoint>& points);

// Notices of what the means take into account, and of what they cannot.
Notices uneven_visits(const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
