// Steps of recognise_sequence(): which stop is at which target, approached from where, and which
// stops are of no target.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/sequence/sequence.h"
#include "schema/plausibility/plausibility.h"
#include "schema/point.h"

namespace mdof::algo {

// A stop that was overshot by this at the most has the approach of the way that led to it: the last
// motion was a correction. Beyond, the axis was sent past the target to come from the other side.
inline constexpr double kMostOvershoot_m = 0.25e-3;

// Targets where the axis stopped: positions are sorted and cut where the step to the next is ten
// times the scatter within a target (and over 2 µm). Each target is where the axis first stopped
// for it, ascending; so it does not change as more stops come.
std::vector<double> targets_of_stops(const std::vector<Point>& points);
std::size_t nearest_target(const std::vector<double>& targets_m, double position_m);

// Where a stop was overshot by kMostOvershoot_m at the most and the axis came back, the direction
// is that of the way from the stop before. Gives how many there are.
int correct_overshot(std::vector<Point>& points);

// Whether it was one, of a single stop.
bool correct_overshot(Point& stop);

// Where the axis was before nobody saw it, it is taken to have stayed; elsewhere to be on its way
// to the next stop.
void assume_approaches(std::vector<MeasuredPoint>& points);

// Two stops in a row at one target and from one side, between which the axis did not go away, are
// one: the longer is kept.
void merge_interrupted(std::vector<MeasuredPoint>& points);

// `part` goes on with `stop`, as above: then it is taken into it.
bool merge_into(MeasuredPoint& stop, MeasuredPoint& part);

// Takes out of `points` what stands at no target, as the other stops show: a parked axis, a pause,
// the place where it turns round. Targets without points go out of `targets_m`, and the others are
// numbered anew.
std::vector<StopLeftOut> leave_out_odd_stops(std::vector<MeasuredPoint>& points,
                                             std::vector<double>& targets_m);
// The same for a first stop at a target that the axis then approaches properly.
std::vector<StopLeftOut> leave_out_parked_start(std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
