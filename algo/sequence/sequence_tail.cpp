#include "algo/sequence/sequence_tail.h"

#include <algorithm>
#include <cmath>

#include "algo/points/flags.h"
#include "algo/sequence/sequence_stops.h"

namespace mdof::algo {
namespace {

// A stop at a larger distance from each target is a new target.
constexpr double kNewTarget_m = 50e-6;

}  // namespace

SequenceTail::SequenceTail(const Sequence& sequence, SequenceOptions options)
    : options_(std::move(options)),
      by_passes_(sequence.by_passes),
      passes_(sequence.targets),
      passes_before_(passes_) {
  for (const MeasuredPoint& p : sequence.points) number(p);
  const std::size_t n = sequence.points.size();
  if (n == 0) return;
  const bool stayed = n > 1 && sequence.points[n - 2].target == sequence.points[n - 1].target;
  awaits_direction_ = has_flag(sequence.points.back().point, Flag::approach_assumed) && !stayed;
}

int SequenceTail::number(const MeasuredPoint& p) {
  passes_before_ = passes_;
  const int pass = passes_.next({p.target, p.point.direction});
  const int visit = ++visits_[{p.target_m, p.point.direction}];
  return by_passes_ ? pass : visit;
}

// Returns false if the point is at no target of options_.targets_m.
bool SequenceTail::place(MeasuredPoint& p, Sequence& sequence) const {
  auto& targets_m = sequence.targets_m;
  const double at_m = p.point.position_m;
  std::size_t t = targets_m.empty() ? 0 : nearest_target(targets_m, at_m);
  const double off_m = targets_m.empty() ? HUGE_VAL : std::abs(targets_m[t] - at_m);
  if (!options_.targets_m.empty()) {
    if (off_m > options_.target_window_m) return false;
  } else if (off_m > kNewTarget_m) {
    const auto above = std::lower_bound(targets_m.begin(), targets_m.end(), at_m);
    t = static_cast<std::size_t>(above - targets_m.begin());
    targets_m.insert(above, at_m);
    ++sequence.targets;
    if (t + 1 < targets_m.size())
      for (MeasuredPoint& other : sequence.points) other.target += other.target_m > at_m;
  }
  p.target = static_cast<int>(t) + 1;
  p.target_m = targets_m[t];
  return true;
}

// Sets the approach of the last point to the direction of the motion to `next`.
void SequenceTail::set_last_direction(const MeasuredPoint& next, Sequence& sequence) {
  awaits_direction_ = false;
  MeasuredPoint& last = sequence.points.back();
  const int direction = next.target < last.target ? -1 : 1;
  if (direction == last.point.direction) return;
  --visits_[{last.target_m, last.point.direction}];
  passes_ = passes_before_;
  last.point.direction = direction;
  last.run = number(last);
}

std::size_t SequenceTail::append(Point stop, Sequence& sequence) {
  auto& points = sequence.points;
  MeasuredPoint p;
  correct_overshot(stop);
  p.point = std::move(stop);
  if (!place(p, sequence)) {
    sequence.left_out.push_back(
        {p.point.position_m, p.point.begin_ns, to_string(NoticeCode::stop_near_no_target)});
    return points.size();
  }
  const std::size_t first_changed = points.size() - (awaits_direction_ ? 1 : 0);
  if (awaits_direction_) set_last_direction(p, sequence);
  if (p.point.direction == 0) {
    const bool stayed = !points.empty() && points.back().target == p.target;
    p.point.direction = stayed ? points.back().point.direction : 1;
    awaits_direction_ = !stayed;
    add_flag(p.point, Flag::approach_assumed);
  }
  if (!points.empty()) {
    const int run = points.back().run;
    if (merge_into(points.back(), p)) {
      points.back().run = run;
      points.back().target_m =
          sequence.targets_m[static_cast<std::size_t>(points.back().target) - 1];
      return points.size() - 1;
    }
  }
  p.run = number(p);
  sequence.runs = std::max(sequence.runs, p.run);
  points.push_back(std::move(p));
  return std::min(first_changed, points.size() - 1);
}

}  // namespace mdof::algo
