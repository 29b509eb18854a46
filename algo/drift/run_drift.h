// The drift of a run: of its five errors and of its probes, from repeated visits of its targets.
//
// A run that visits each target once from each side does not separate a drift from the form and
// slope of the axis and its reversal; a second run does. Between runs alone, a steady drift and
// steps from run to run look the same: machines have both. Within the runs they differ, where the
// axis goes both ways: a drift shifts the two visits of a target by as much as lies between them,
// and a step does not. Only what is likelier to be a drift than steps from pass to pass, by e⁵
// (both with one reversal for all targets), is one; runs of one direction do not show it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "algo/drift/series_drift.h"
#include "schema/point.h"

namespace mdof::algo {

// By how much the errors had changed when the axis came back to where a run began.
struct Closure {
  int run = 0;
  double after_s = 0;
  bool same_side = true;  // false: it came from the other side, and the reversal is in it
  Errors5 change{};       // local; m, rad
};

struct RunDrift {
  std::string not_seen;                 // why no drift can be stated; empty: it can
  double length_s = 0;                  // from the first point to the last
  std::array<SeriesDrift, 5> errors{};  // local, of the target; m, rad
  std::vector<SeriesDrift> probes;      // in the order of the rig; m. Empty: not_seen
  std::vector<Closure> closures;        // of each run whose start was visited again

  bool significant() const;  // of any error
  bool removable() const;    // one at least that cannot be steps
};

class DriftOfRun {
 public:
  // Points stated at the fixture, where an error does not have the travel in it. Those without
  // errors, or with an unknown approach, show nothing.
  explicit DriftOfRun(const std::vector<MeasuredPoint>& points);

  const RunDrift& found() const { return found_; }
  // The points without the significant drifts of their errors since the first point, where the
  // system was zeroed; what a drift did before is in all points.
  std::vector<MeasuredPoint> without(std::vector<MeasuredPoint> points) const;
  // Where these points are what without() left: by how much each may be wrong for that, as
  // independent parts whose squares add, with freedom() degrees of freedom. Which drifts were taken
  // is seen in the points: of those nothing is left.
  std::vector<std::vector<Errors5>> removal_shifts(const std::vector<MeasuredPoint>& points) const;
  double freedom() const;

 private:
  RunDrift found_;
  std::optional<DriftFit> fit_;  // of the errors
};

// The middle of a point's samples.
double time_of_s(const MeasuredPoint& point);

}  // namespace mdof::algo
