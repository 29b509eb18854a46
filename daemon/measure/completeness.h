// Decides whether a run is complete. Live runs, replays and the command line use the same rule.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::daemon {

// Whether each target has at least `repeats` solved points with forward approach, and as many with
// reverse approach. False if `repeats` is 0.
bool all_measured(const std::vector<double>& targets_m, int repeats,
                  const std::vector<MeasuredPoint>& points);

// Notices that state why the run is partial; empty if the run is complete.
//   If repeats > 0: for each target and approach, the number of missing or unsolved points.
//   If repeats == 0: the targets that have no solved point.
//   The number of unsolved points, if it is more than half of all points or if there is another
//   notice.
Notices missing_notices(const std::vector<double>& targets_m, int repeats,
                        const std::vector<MeasuredPoint>& points);

}  // namespace mdof::daemon
