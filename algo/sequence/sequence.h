// Assigns points to targets, runs and approaches (ISO 230-2 i, j, ↑↓).
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
  // Nominal positions, ascending; empty: recognised from the stops of the axis.
  std::vector<double> targets_m;
  // A stop farther than this from each nominal position is at no target (only with targets_m).
  double target_window_m = 0.25e-3;
};

struct Sequence {
  std::vector<MeasuredPoint> points;  // in time order, errors not yet solved
  Notices notices;                    // what was left out, and why
  std::vector<StopLeftOut> left_out;
  std::vector<double> targets_m;  // ascending
  Cycle cycle = Cycle::none;
  bool by_passes = false;  // see CycleFound
  int targets = 0, runs = 0;
};

// Targets are the given ones, or the positions of the stops (sequence_stops.h). Stops at no target
// are left out and reported: with given targets those near none of them; without given targets
// those that the other stops show to be a parked axis, a pause or a reversal. Two consecutive stops
// at one target with one approach, without a departure of the axis, are one interrupted stop; the
// longer one is kept. A point with unknown approach (the log begins there, or the axis was not
// observed before it) is assumed to continue the stop before it at the same target, or else to
// belong to the next motion; it gets the flag "approach_assumed". Runs: see recognise_cycle().
Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options);

}  // namespace mdof::algo
