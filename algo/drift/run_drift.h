// Finds the drift of the five errors and of the probes during a run from repeated visits of the
// targets.
//
// If each target is visited once from each side, a drift cannot be distinguished from the form, the
// slope and the reversal of the axis. A second pass in each direction is necessary. Errors of a
// machine change by steady drifts and by steps from pass to pass. A drift and a step can be
// distinguished only if the axis moves in both directions:
// - The effect of a drift on the difference of two visits of a target depends on the time between
//   the visits.
// - The effect of a step on this difference does not depend on the time.
//
// mdof accepts a drift only if the drift is more likely than steps from pass to pass by a factor of
// e⁵. Both models have one reversal for all targets.
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
  // false: the return approached the position from the other side, so the change contains the
  // reversal.
  bool same_side = true;
  Errors5 change{};  // local; m, rad
};

struct RunDrift {
  std::string not_seen;  // why no drift can be determined; empty: drifts are determined
  double length_s = 0;   // time from the first point to the last
  std::array<SeriesDrift, 5> errors{};  // local errors of the target; m, rad
  std::vector<SeriesDrift> probes;      // in the order of the rig, m; empty if not_seen is set
  std::vector<Closure> closures;        // one for each run whose start position was visited again

  bool significant() const;  // any error has a significant drift
  bool removable() const;    // at least one significant drift that cannot be steps
};

class DriftOfRun {
 public:
  // The reference point of the errors of `points` must be the fixture, because the errors at
  // another point depend on the travel. Points without errors or with an unknown approach are
  // ignored.
  explicit DriftOfRun(const std::vector<MeasuredPoint>& points);

  const RunDrift& found() const { return found_; }
  // Returns the points with errors from which the significant drifts since the first point are
  // subtracted. The system was zeroed at the first point; an earlier drift remains in all points.
  std::vector<MeasuredPoint> without(std::vector<MeasuredPoint> points) const;
  // Returns the uncertainty of without() as [part][point]: the effect of one standard uncertainty
  // of each independent part on the errors of each point. The squares of the parts add; they have
  // freedom() degrees of freedom.
  std::vector<std::vector<Errors5>> removal_shifts(const std::vector<MeasuredPoint>& points) const;
  double freedom() const;
  // For each error, the largest effect on the reversal of a target of the significant changes that
  // without() does not subtract, or of all significant changes. 0: no significant change, or not
  // more than twice the standard uncertainty of this reversal due to noise. `points`: as measured.
  Errors5 left_in_reversal(const std::vector<MeasuredPoint>& points, bool is_removed) const;

 private:
  RunDrift found_;
  std::optional<DriftFit> fit_;  // fit of the errors
};

// Returns the time in the middle of a point's samples.
double middle_time_s(const MeasuredPoint& point);

}  // namespace mdof::algo
