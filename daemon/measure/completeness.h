// Decides whether a run is complete, in the same way for live runs, replays and the command line.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::daemon {

// Whether each target has `repeats` solved points from both sides. False if `repeats` is 0.
bool all_measured(const std::vector<double>& targets_m, int repeats,
                  const std::vector<MeasuredPoint>& points);

// Reasons why the run is partial; empty if it is complete.
//   targets and repeats: points that are missing or could not be solved, by target and approach
//   targets alone:       targets that were never measured
//   always:              most of the points could not be solved
Notices missing_notices(const std::vector<double>& targets_m, int repeats,
                        const std::vector<MeasuredPoint>& points);

}  // namespace mdof::daemon
