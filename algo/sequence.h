// Puts points in their place: which target, which run, which approach (ISO 230-2 i, j, ↑↓).
#pragma once

#include <string>
#include <vector>

#include "schema/point.h"
#include "schema/result.h"

namespace mdof::algo {

// Flag of a point whose approach the log does not show.
inline constexpr const char* kApproachAssumed = "approach_assumed";

struct SequenceOptions {
  // Nominal positions, ascending; empty: recognised from where the axis stopped.
  std::vector<double> targets_m;
  // A stop further than this from each nominal position is no target (only with targets_m).
  double target_window_m = 0.25e-3;
};

struct Sequence {
  std::vector<MeasuredPoint> points;  // in time order, errors not yet solved
  std::vector<std::string> warnings;  // what was left out and why
  int targets = 0, runs = 0;
};

// Targets: positions are sorted and cut where the step to the next is ten times the scatter within
// a target (and over 2 µm). A pass is a row of stops with one approach, in order; the k-th pass of
// an approach is run k. Two stops in a row at one target with one approach are one interrupted
// stop: the longer is kept. A point whose approach is not known (the log begins there, or nobody
// saw the axis before it) is taken to go on with the stop before it at the same target, else to
// belong to the motion that follows, and is flagged "approach_assumed".
Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options);

}  // namespace mdof::algo
