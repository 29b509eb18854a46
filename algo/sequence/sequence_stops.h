// Functions of recognise_sequence(). They determine the target and the approach of each stop, and
// find the stops that are at no target.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/sequence/sequence.h"
#include "schema/plausibility/plausibility.h"
#include "schema/point.h"

namespace mdof::algo {

// If the axis overshoots a target by at most this, the last motion back was a correction, and the
// approach is the direction of the whole path to the target. With a larger overshoot, the axis was
// commanded past the target to approach it from the other side.
inline constexpr double kMostOvershoot_m = 0.25e-3;

// Returns the targets from the stops of the axis, in ascending order. The sorted positions are
// divided where the distance to the next position is at least ten times the scatter within a target
// (and above 2 µm). If most motions then are within a target and without an overrun, the positions
// are divided at each distance above 2 µm, if this gives at least two stops for each target on
// average. The position of a target is the position of its first stop, so that later stops do not
// change it. Exception: if the axis was only parked beside its first target, the position is that
// of the next stop.
std::vector<double> stop_targets(const std::vector<Point>& points);
std::size_t nearest_target(const std::vector<double>& targets_m, double position_m);

// If the axis overshot a stop by more than 40 µm and at most kMostOvershoot_m and moved back, the
// direction of the stop is set to the direction of the path from the stop before. Returns the
// number of such stops.
int correct_overshot(std::vector<Point>& points);

// The same for a single stop. Returns whether the axis overshot it.
bool correct_overshot(Point& stop);

// Sets the approach of points with unknown approach. If the stop before is at the same target, the
// point gets the approach of this stop. Otherwise it gets the approach of the motion to the next
// stop.
void assume_approaches(std::vector<MeasuredPoint>& points);

struct MergedStop {
  double position_m = 0, moved_m = 0;  // moved_m: range of the positions from stop to stop
};

// Merges two consecutive stops at one target with the same approach if the axis did not leave the
// target between them: it moved by at most 10 µm past both stops to one side, or by 50 µm to both
// sides. The longer stop is kept. If their distances from the target differ by more than 10 µm, the
// nearer stop is kept. Returns the merged stops between which the axis moved by more than 2 µm.
std::vector<MergedStop> merge_interrupted(std::vector<MeasuredPoint>& points);

// Merges `part` into `stop` under the conditions of merge_interrupted(). Returns whether they were
// merged.
bool merge_into(MeasuredPoint& stop, MeasuredPoint& part);

struct OddStops {
  std::vector<StopLeftOut> left_out;
  // The target at which the log begins, if it was not approached from both sides although other
  // targets were. The axis may only have been parked or reversed there. 0: no such target.
  int assumed_target = 0;
};

// Finds by comparison with the other stops the stops at no target (a parked axis, a pause, a
// reversal). The first stop of the log is no visit if its approach was not observed. Removes these
// stops from `points` and returns them. Removes targets without points from `targets_m`; the target
// numbers of the points are changed accordingly.
OddStops leave_out_odd_stops(std::vector<MeasuredPoint>& points, std::vector<double>& targets_m);
// Only for nominal targets. The distance of a stop from its target is |position - target - shift|;
// the shift is the median of (position - target) over all stops. A stop is beside its target if
// this distance exceeds both 10 µm and ten times the median distance of all stops. Removes and
// returns each stop beside its target for which the axis also stopped at the target, without a stop
// at another target in between.
std::vector<StopLeftOut> leave_out_beside_targets(std::vector<MeasuredPoint>& points);
// Removes and returns the first stop of the log if its approach was not observed, and the next stop
// is at the same target with the same approach after the axis left the target.
std::vector<StopLeftOut> leave_out_parked_start(std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
