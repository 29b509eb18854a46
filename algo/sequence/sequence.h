// Assigns points to targets, runs and approaches (i, j, ↑↓ of ISO 230-2).
#pragma once

#include <string>
#include <vector>

#include "algo/sequence/sequence_cycle.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/plausibility/plausibility.h"
#include "schema/point.h"

namespace mdof::algo {

struct SequenceOptions {
  // Nominal positions, ascending; empty: the targets are recognised from the stops of the axis.
  std::vector<double> targets_m;
  // A stop is at no target if its distance from each nominal position is larger than this (only
  // with targets_m).
  double target_window_m = 0.25e-3;
};

struct Sequence {
  std::vector<MeasuredPoint> points;  // in the order of time; the errors are not yet solved
  Notices notices;                    // which stops were left out, and why
  std::vector<StopLeftOut> left_out;
  std::vector<double> targets_m;  // ascending
  Cycle cycle = Cycle::none;
  bool by_passes = false;  // see CycleFound
  int targets = 0, runs = 0;
};

// Assigns a target, a run and an approach to each point. The targets are options.targets_m or, if
// these are empty, the positions of the stops (sequence_stops.h). The runs are from
// recognise_cycle().
// - Stops at no target are left out and reported. With targets_m, these are stops that are near to
//   no target. Without targets_m, they are found by comparison with the other stops: a parked axis,
//   a pause, or a reversal.
// - Two consecutive stops at one target with the same approach are one interrupted stop if the axis
//   did not leave the target between them. The longer stop is kept.
// - The approach of a point is unknown if the log begins there or if the axis was not observed
//   before it. If the stop before is at the same target, the point is assumed to continue this
//   stop. Otherwise it is assumed to have the approach of the next motion. The point gets the flag
//   "approach_assumed".
Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options);

}  // namespace mdof::algo
