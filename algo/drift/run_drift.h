// The drift of a run: of its five errors and of its probes, from repeated visits of its targets.
//
// A run that visits each target once from each side does not separate a drift from the form, slope
// and reversal of the axis; a second run does. Between runs alone, a steady drift and steps from
// run to run look the same, and machines have both. Within runs they differ if the axis moves in
// both directions: the effect of a drift on the difference of the two visits of a target depends on
// the time between them, the effect of a step does not. mdof accepts a drift only if it is more
// likely than steps from pass to pass by a factor of e⁵ (both with one reversal for all targets).
// Runs of one direction do not show the difference.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "algo/drift/series_drift.h"
#include "schema/point.h"

namespace mdof::algo {

// Change of the errors between the start of a run and the return of the axis to the start position.
struct Closure {
  int run = 0;
  double after_s = 0;
  // False: approached from the other side, so the change contains the reversal.
  bool same_side = true;
  Errors5 change{};  // local; m, rad
};

struct RunDrift {
  std::string not_seen;                 // why no drift can be stated; empty: a drift can be stated
  double length_s = 0;                  // from the first point to the last
  std::array<SeriesDrift, 5> errors{};  // local, of the target; m, rad
  std::vector<SeriesDrift> probes;      // in the order of the rig; m; empty if not_seen is set
  std::vector<Closure> closures;        // one for each run whose start position was visited again

  bool significant() const;  // any error
  bool removable() const;    // at least one drift that cannot be steps
};

class DriftOfRun {
 public:
  // `points` must be stated at the fixture, where an error does not contain the travel. Points
  // without errors or with an unknown approach are ignored.
  explicit DriftOfRun(const std::vector<MeasuredPoint>& points);

  const RunDrift& found() const { return found_; }
  // The points minus the significant drifts of their errors since the first point, where the system
  // was zeroed. All points contain the drift before that.
  std::vector<MeasuredPoint> without(std::vector<MeasuredPoint> points) const;
  // The uncertainty of points from without(): independent parts whose squares add, with freedom()
  // degrees of freedom; each part has the possible error of each point. The points show which
  // drifts were removed, because such a drift is 0 in them.
  std::vector<std::vector<Errors5>> removal_shifts(const std::vector<MeasuredPoint>& points) const;
  double freedom() const;

 private:
  RunDrift found_;
  std::optional<DriftFit> fit_;  // fit of the errors
};

// The middle of a point's samples.
double middle_time_s(const MeasuredPoint& point);

}  // namespace mdof::algo
