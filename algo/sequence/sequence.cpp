#include "algo/sequence/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "algo/sequence/sequence_stops.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostNamed = 5;  // positions named in one warning

std::string millimetres(double m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4f mm", to_mm(m));
  return text.data();
}

void append(std::vector<StopLeftOut>& to, std::vector<StopLeftOut> more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

void place(const std::vector<Point>& points, const SequenceOptions& options, Sequence& sequence) {
  const bool nominal = !options.targets_m.empty();
  sequence.targets_m = nominal ? options.targets_m : targets_of_stops(points);
  for (const Point& p : points) {
    const std::size_t t = nearest_target(sequence.targets_m, p.position_m);
    if (nominal && std::abs(sequence.targets_m[t] - p.position_m) > options.target_window_m) {
      sequence.left_out.push_back({p.position_m, p.begin_ns, "near no target"});
      continue;
    }
    MeasuredPoint m;
    m.target = static_cast<int>(t) + 1;
    m.point = p;
    sequence.points.push_back(std::move(m));
  }
}

void number_runs(Sequence& sequence) {
  std::vector<Visit> visits;
  for (const auto& p : sequence.points) visits.push_back({p.target, p.point.direction});
  const CycleFound found = recognise_cycle(visits, static_cast<int>(sequence.targets_m.size()));
  sequence.cycle = found.cycle;
  sequence.by_passes = found.by_passes;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    MeasuredPoint& p = sequence.points[i];
    p.run = found.run[i];
    p.target_m = sequence.targets_m[static_cast<std::size_t>(p.target) - 1];
    sequence.runs = std::max(sequence.runs, p.run);
  }
}

// One warning a reason, with the first few positions.
void tell_left_out(Sequence& sequence) {
  std::vector<std::string> reasons;
  for (const auto& stop : sequence.left_out) {
    if (std::find(reasons.begin(), reasons.end(), stop.reason) == reasons.end())
      reasons.push_back(stop.reason);
  }
  for (const auto& reason : reasons) {
    std::string where;
    std::size_t count = 0;
    Severity severity = Severity::doubtful;
    for (const auto& stop : sequence.left_out) {
      if (stop.reason != reason) continue;
      severity = stop.severity;
      if (count++ < kMostNamed) where += (where.empty() ? "" : ", ") + millimetres(stop.position_m);
    }
    if (count > kMostNamed) where += ", ...";
    const std::string what =
        count == 1 ? "a stop at " + where + " was" : std::to_string(count) + " stops were";
    sequence.warnings.push_back(with_severity(
        severity, what + " left out (" + reason + ")" + (count == 1 ? "" : ": at " + where)));
  }
}

void tell_overshot(int count, Sequence& sequence) {
  if (count == 0) return;
  const std::string stops = count == 1 ? "1 stop was" : std::to_string(count) + " stops were";
  sequence.warnings.push_back(
      stops + " overshot by up to " + millimetres(kMostOvershoot_m) +
      " before the axis came back: counted in the direction of travel, and flagged \"" + kOvershot +
      "\"; the last motion was the other way");
}

void tell_order(Sequence& sequence) {
  if (sequence.cycle != Cycle::none) return;
  sequence.warnings.push_back(
      "the order of the targets is no standard, pendulum, pilgrim or quasi-pilgrim cycle: the k-th "
      "visit of a target in a direction is counted as run k");
}

}  // namespace

Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options) {
  Sequence sequence;
  if (points.empty()) return sequence;
  std::vector<Point> stops = points;
  const int overshot = correct_overshot(stops);
  place(stops, options, sequence);
  assume_approaches(sequence.points);
  merge_interrupted(sequence.points);
  append(sequence.left_out, leave_out_parked_start(sequence.points));
  if (options.targets_m.empty())
    append(sequence.left_out, leave_out_odd_stops(sequence.points, sequence.targets_m));
  sequence.targets = static_cast<int>(sequence.targets_m.size());
  number_runs(sequence);
  tell_left_out(sequence);
  tell_overshot(overshot, sequence);
  tell_order(sequence);
  return sequence;
}

}  // namespace mdof::algo
