// Is a run what was asked for? One judgement for live runs, replays and the command line.
#pragma once

#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/point.h"

namespace mdof::daemon {

// Each target has been measured and solved as often as was asked for, from both sides. False where
// nobody said how often.
bool all_measured(const std::vector<double>& targets_m, int repeats,
                  const std::vector<MeasuredPoint>& points);

// What makes the run a partial one; empty: it is complete.
//   targets and repeats: points that are missing, or could not be solved, by target and approach
//   targets alone:       targets that were never measured
//   always:              most of the points could not be solved
Notices missing_notices(const std::vector<double>& targets_m, int repeats,
                        const std::vector<MeasuredPoint>& points);

}  // namespace mdof::daemon
