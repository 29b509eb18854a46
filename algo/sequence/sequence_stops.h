// Steps of recognise_sequence(): the target and the approach of each stop, and the stops that are
// at no target.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/sequence/sequence.h"
#include "schema/plausibility/plausibility.h"
#include "schema/point.h"

namespace mdof::algo {

// A stop with at most this overshoot has the approach of the path to it, because the last motion
// was a correction. With a larger overshoot the axis was commanded past the target to approach it
// from the other side.
inline constexpr double kMostOvershoot_m = 0.25e-3;

// Targets from the stops of the axis: the sorted positions are divided where the distance to the
// next is at least ten times the scatter within a target (and above 2 µm). The position of each
// target is its first stop, so that it does not change with later stops. Ascending.
std::vector<double> stop_targets(const std::vector<Point>& points);
std::size_t nearest_target(const std::vector<double>& targets_m, double position_m);

// If a stop was overshot by at most kMostOvershoot_m and the axis came back, its direction becomes
// that of the path from the stop before. Returns the number of such stops.
int correct_overshot(std::vector<Point>& points);

// The same for a single stop; returns whether it was overshot.
bool correct_overshot(Point& stop);

// Sets unknown approaches: a point at the target of the stop before continues this stop, any other
// belongs to the motion to the next stop.
void assume_approaches(std::vector<MeasuredPoint>& points);

// Merges two consecutive stops at one target and from one side, without a departure of the axis;
// the longer one is kept.
void merge_interrupted(std::vector<MeasuredPoint>& points);

// Merges `part` into `stop` if it continues it as above.
bool merge_into(MeasuredPoint& stop, MeasuredPoint& part);

// Removes from `points` the stops at no target, as the other stops show: a parked axis, a pause, a
// reversal. Targets without points are removed from `targets_m`, and the others are renumbered.
std::vector<StopLeftOut> leave_out_odd_stops(std::vector<MeasuredPoint>& points,
                                             std::vector<double>& targets_m);
// The same for a first stop at a target that the axis leaves and then approaches again.
std::vector<StopLeftOut> leave_out_parked_start(std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
