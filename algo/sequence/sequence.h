// Puts points in their place: which target, which run, which approach (ISO 230-2 i, j, ↑↓).
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
  // Nominal positions, ascending; empty: recognised from where the axis stopped.
  std::vector<double> targets_m;
  // A stop further than this from each nominal position is no target (only with targets_m).
  double target_window_m = 0.25e-3;
};

struct Sequence {
  std::vector<MeasuredPoint> points;  // in time order, errors not yet solved
  Notices notices;                    // what was left out and why
  std::vector<StopLeftOut> left_out;
  std::vector<double> targets_m;  // ascending
  Cycle cycle = Cycle::none;
  bool by_passes = false;  // see CycleFound
  int targets = 0, runs = 0;
};

// Targets are those given, or where the axis stopped (sequence_stops.h). Stops of no target are
// left out and reported: near no given target; where none are given, those that the other stops
// show to be a parked axis, a pause or a turning point. Two stops in a row at one target with one
// approach, between which the axis did not leave it, are one interrupted stop: the longer is kept.
// A point whose approach is not known (the log begins there, or nobody saw the axis before it) is
// taken to go on with the stop before it at the same target, else to belong to the motion that
// follows, and is flagged "approach_assumed". Runs: see recognise_cycle().
Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options);

}  // namespace mdof::algo
