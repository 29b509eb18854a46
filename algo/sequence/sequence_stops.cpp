#include "algo/sequence/sequence_stops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "algo/points/flags.h"
#include "algo/points/median.h"
#include "algo/points/motion_trace.h"

namespace mdof::algo {
namespace {

constexpr double kMinStep_m = 2e-6;      // stops at smaller distances are always one target
constexpr double kMaxScatter_m = 50e-6;  // groups with a larger range are never one target
constexpr double kStepToScatter = 10;
// MotionTrace::by_last_motion() handles smaller overshoots.
constexpr double kLeastOvershoot_m = 40e-6;

// Returns the largest distance of neighbouring sorted positions that belong to one target.
double scatter_limit(const std::vector<double>& sorted) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i) steps.push_back(sorted[i] - sorted[i - 1]);
  std::sort(steps.begin(), steps.end());
  double limit = kMinStep_m, best_ratio = kStepToScatter;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const double scatter = std::max(steps[i], kMinStep_m);
    const double ratio = steps[i + 1] / scatter;
    if (scatter <= kMaxScatter_m && ratio >= best_ratio) {
      best_ratio = ratio;
      limit = scatter;
    }
  }
  return limit;
}

// Returns the first position of each group of positions.
std::vector<double> divided(const std::vector<double>& sorted, double limit) {
  std::vector<double> first;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (i == 0 || sorted[i] - sorted[i - 1] > limit) first.push_back(sorted[i]);
  return first;
}

std::size_t group_of(const std::vector<double>& first, double position_m) {
  const auto above = std::upper_bound(first.begin(), first.end(), position_m);
  return static_cast<std::size_t>(above - first.begin()) - 1;
}

// Returns whether most motions are steps within a group, without an overrun: the distances of the
// targets then were taken for their scatter.
bool steps_within_targets(const std::vector<Point>& points, const std::vector<double>& first) {
  std::size_t steps = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double from_m = points[i - 1].position_m, to_m = points[i].position_m;
    const double step_m = std::abs(to_m - from_m);
    const bool is_direct = points[i].travel_max_m - points[i].travel_min_m < step_m + kMinStep_m;
    steps += group_of(first, from_m) == group_of(first, to_m) && step_m > kMinStep_m && is_direct;
  }
  return 2 * steps > points.size();
}

// Returns whether the axis left the stop between `before` and `p`. It then was farther from `p`
// than kMaxScatter_m, or moved past both stops to one side. A vibration moves it to both sides.
bool has_left_stop(const Point& before, const Point& p) {
  const auto [low_m, high_m] = std::minmax(before.position_m, p.position_m);
  const double up_m = p.travel_max_m - high_m, down_m = low_m - p.travel_min_m;
  const double farther_m = std::max(up_m, down_m);
  return p.travel_max_m - p.position_m > kMaxScatter_m ||
         p.position_m - p.travel_min_m > kMaxScatter_m ||
         (farther_m > kLeastTurn_m && 2 * std::min(up_m, down_m) < farther_m);
}

// Returns whether `part`, not `stop`, is averaged: it is nearer to the target, or is about equally
// near and has more samples. If the axis moved to the target in two steps, the stop at the target
// is averaged.
bool is_better(const MeasuredPoint& part, const MeasuredPoint& stop) {
  const double part_off_m = std::abs(part.point.position_m - part.target_m);
  const double stop_off_m = std::abs(stop.point.position_m - part.target_m);
  if (std::abs(part_off_m - stop_off_m) > kLeastTurn_m) return part_off_m < stop_off_m;
  return part.point.samples > stop.point.samples;
}

double moved_between(const Point& before, const Point& p) {
  const double high_m = std::fmax(std::max(before.position_m, p.position_m), p.travel_max_m);
  return high_m - std::fmin(std::min(before.position_m, p.position_m), p.travel_min_m);
}

}  // namespace

std::vector<double> stop_targets(const std::vector<Point>& points) {
  std::vector<double> sorted;
  for (const Point& p : points) sorted.push_back(p.position_m);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> targets = divided(sorted, scatter_limit(sorted));
  if (steps_within_targets(points, targets)) {
    const std::vector<double> closer = divided(sorted, kMinStep_m);
    if (2 * closer.size() <= points.size()) targets = closer;
  }
  std::vector<bool> named(targets.size(), false);
  std::vector<double> first = targets;
  for (const Point& p : points) {
    const std::size_t t = group_of(targets, p.position_m);
    // The axis may be parked beside its first target.
    const bool parked_beside = points.front().direction == 0 && p.direction != 0 &&
                               first[t] == points.front().position_m &&
                               std::abs(p.position_m - first[t]) > kLeastTurn_m;
    if (!named[t] || parked_beside) first[t] = p.position_m;
    named[t] = true;
  }
  return first;
}

std::size_t nearest_target(const std::vector<double>& targets_m, double position_m) {
  const auto above = std::lower_bound(targets_m.begin(), targets_m.end(), position_m);
  if (above == targets_m.begin()) return 0;
  const auto i = static_cast<std::size_t>(above - targets_m.begin());
  if (above == targets_m.end()) return i - 1;
  return *above - position_m < position_m - targets_m[i - 1] ? i : i - 1;
}

bool correct_overshot(Point& p) {
  const double above_m = p.travel_max_m - p.position_m, below_m = p.position_m - p.travel_min_m;
  // Overshot: the direction of the last motion and the direction of the whole path differ.
  const double overshot_m = p.direction < 0 ? above_m : below_m;
  const double approach_travel_m = p.direction < 0 ? below_m : above_m;
  const bool overshot = overshot_m > kLeastOvershoot_m && overshot_m <= kMostOvershoot_m;
  if (p.direction == 0 || !overshot || !(approach_travel_m > 2 * overshot_m)) return false;
  p.direction = -p.direction;
  add_flag(p, Flag::overshot);
  return true;
}

int correct_overshot(std::vector<Point>& points) {
  int count = 0;
  for (Point& p : points) count += correct_overshot(p);
  return count;
}

void assume_approaches(std::vector<MeasuredPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point& p = points[i].point;
    if (p.direction != 0) continue;
    const bool stayed = i > 0 && points[i - 1].target == points[i].target;
    const bool back = i + 1 < points.size() && points[i + 1].target < points[i].target;
    p.direction = stayed ? points[i - 1].point.direction : back ? -1 : 1;
    add_flag(p, Flag::approach_assumed);
  }
}

bool merge_into(MeasuredPoint& stop, MeasuredPoint& part) {
  if (stop.target != part.target || stop.point.direction != part.point.direction ||
      has_left_stop(stop.point, part.point))
    return false;
  if (is_better(part, stop)) {
    // The merged stop keeps the path of its first part.
    part.point.travel_min_m = stop.point.travel_min_m;
    part.point.travel_max_m = stop.point.travel_max_m;
    stop = std::move(part);
  }
  add_flag(stop.point, Flag::interrupted);
  return true;
}

std::vector<MergedStop> merge_interrupted(std::vector<MeasuredPoint>& points) {
  std::vector<MeasuredPoint> merged;
  std::vector<MergedStop> moved;
  for (auto& p : points) {
    const MergedStop stop = {p.point.position_m,
                             merged.empty() ? 0 : moved_between(merged.back().point, p.point)};
    if (merged.empty() || !merge_into(merged.back(), p))
      merged.push_back(std::move(p));
    else if (stop.moved_m > kMinStep_m)
      moved.push_back(stop);
  }
  points = std::move(merged);
  return moved;
}

std::vector<StopLeftOut> leave_out_beside_targets(std::vector<MeasuredPoint>& points) {
  std::vector<double> off_m;
  for (const MeasuredPoint& p : points) off_m.push_back(p.point.position_m - p.target_m);
  // All positions may be shifted against the nominal positions.
  const double shift_m = median_of(off_m);
  for (double& off : off_m) off = std::abs(off - shift_m);
  const double most_m = std::max(kLeastTurn_m, kStepToScatter * median_of(off_m));
  std::vector<StopLeftOut> left_out;
  std::vector<MeasuredPoint> kept;
  for (std::size_t from = 0, to = 0; from < points.size(); from = to) {
    bool any_near = false;
    for (to = from; to < points.size() && points[to].target == points[from].target; ++to)
      any_near = any_near || off_m[to] <= most_m;
    for (std::size_t i = from; i < to; ++i) {
      const Point& stop = points[i].point;
      const bool parked = i == 0 && has_flag(stop, Flag::approach_assumed);
      if (any_near && off_m[i] > most_m)
        left_out.push_back({stop.position_m, stop.begin_ns,
                            to_string(parked ? NoticeCode::stop_parked_at_start
                                             : NoticeCode::stop_beside_target)});
      else
        kept.push_back(std::move(points[i]));
    }
  }
  points = std::move(kept);
  return left_out;
}

std::vector<StopLeftOut> leave_out_parked_start(std::vector<MeasuredPoint>& points) {
  if (points.size() < 2) return {};
  const MeasuredPoint &parked = points[0], &next = points[1];
  const bool again = next.target == parked.target && next.point.direction == parked.point.direction;
  if (!has_flag(parked.point, Flag::approach_assumed) || !again ||
      !has_left_stop(parked.point, next.point))
    return {};
  std::vector<StopLeftOut> left_out = {{parked.point.position_m, parked.point.begin_ns,
                                        to_string(NoticeCode::stop_parked_at_start)}};
  points.erase(points.begin());
  return left_out;
}

}  // namespace mdof::algo
