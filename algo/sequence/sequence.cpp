#include "algo/sequence/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "algo/points/flags.h"
#include "algo/sequence/sequence_stops.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostNamed = 5;  // positions in one notice

std::string in_mm(double m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4f", to_mm(m));
  return text.data();
}

std::string list_in_mm(const std::vector<double>& positions_m) {
  std::string text;
  for (std::size_t i = 0; i < std::min(positions_m.size(), kMostNamed); ++i)
    text += (i == 0 ? "" : ", ") + in_mm(positions_m[i]);
  return text + (positions_m.size() > kMostNamed ? ", ..." : "");
}

void append(std::vector<StopLeftOut>& to, std::vector<StopLeftOut> more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

// If the log begins while the axis is at rest at no target, this stop is reported as a parked axis.
NoticeCode reason_off_targets(const std::vector<Point>& points, const Point& stop) {
  const bool parked = &stop == &points.front() && stop.direction == 0;
  return parked ? NoticeCode::stop_parked_at_start : NoticeCode::stop_near_no_target;
}

void place(const std::vector<Point>& points, const SequenceOptions& options, Sequence& sequence) {
  const bool nominal = !options.targets_m.empty();
  sequence.targets_m = nominal ? options.targets_m : stop_targets(points);
  for (const Point& p : points) {
    const std::size_t t = nearest_target(sequence.targets_m, p.position_m);
    if (nominal && std::abs(sequence.targets_m[t] - p.position_m) > options.target_window_m) {
      sequence.left_out.push_back(
          {p.position_m, p.begin_ns, to_string(reason_off_targets(points, p))});
      continue;
    }
    MeasuredPoint m;
    m.target = static_cast<int>(t) + 1;
    m.target_m = sequence.targets_m[t];
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

// Returns the largest distance of these positions from the nearest target.
double farthest(const std::vector<double>& positions_m, const std::vector<double>& targets_m) {
  double most_m = 0;
  for (const double at_m : positions_m)
    most_m = std::max(most_m, std::abs(at_m - targets_m[nearest_target(targets_m, at_m)]));
  return most_m;
}

// Adds one notice for each reason with the first few positions.
void note_left_out(Sequence& sequence) {
  std::vector<std::string> reasons;
  for (const auto& stop : sequence.left_out) {
    if (std::find(reasons.begin(), reasons.end(), stop.reason) == reasons.end())
      reasons.push_back(stop.reason);
  }
  for (const auto& reason : reasons) {
    std::vector<double> positions_m;
    for (const auto& stop : sequence.left_out)
      if (stop.reason == reason) positions_m.push_back(stop.position_m);
    const auto code = notice_code_from(reason);
    assert(code);
    const auto count = positions_m.size();
    const std::string at_mm = list_in_mm(positions_m);
    sequence.notices.push_back(
        *code == NoticeCode::stop_beside_target
            ? notice(*code, "",
                     {{"stops", count},
                      {"positions_mm", at_mm},
                      {"distance_mm", to_mm(farthest(positions_m, sequence.targets_m))}})
            : notice(*code, "", {{"stops", count}, {"positions_mm", at_mm}}));
  }
}

void note_merged(const std::vector<MergedStop>& merged, Sequence& sequence) {
  if (merged.empty()) return;
  double most_m = 0;
  std::vector<double> positions_m;
  for (const MergedStop& stop : merged) {
    most_m = std::max(most_m, stop.moved_m);
    positions_m.push_back(stop.position_m);
  }
  sequence.notices.push_back(notice(NoticeCode::stops_merged, "",
                                    {{"stops", merged.size()},
                                     {"positions_mm", list_in_mm(positions_m)},
                                     {"most_um", to_um(most_m)}}));
}

// `stops` have the flag "overshot" and their direction of travel.
void note_overshot(int count, const std::vector<Point>& stops, Sequence& sequence) {
  if (count == 0) return;
  double most_m = 0;
  for (const Point& p : stops) {
    if (!has_flag(p, Flag::overshot)) continue;
    most_m = std::max(
        most_m, p.direction > 0 ? p.travel_max_m - p.position_m : p.position_m - p.travel_min_m);
  }
  sequence.notices.push_back(
      notice(NoticeCode::stop_overshot, "", {{"stops", count}, {"most_mm", to_mm(most_m)}}));
}

}  // namespace

Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options) {
  Sequence sequence;
  if (points.empty()) return sequence;
  std::vector<Point> stops = points;
  const int overshot = correct_overshot(stops);
  place(stops, options, sequence);
  assume_approaches(sequence.points);
  if (!options.targets_m.empty())
    append(sequence.left_out, leave_out_beside_targets(sequence.points));
  note_merged(merge_interrupted(sequence.points), sequence);
  append(sequence.left_out, leave_out_parked_start(sequence.points));
  OddStops odd;
  if (options.targets_m.empty()) odd = leave_out_odd_stops(sequence.points, sequence.targets_m);
  append(sequence.left_out, std::move(odd.left_out));
  sequence.targets = static_cast<int>(sequence.targets_m.size());
  number_runs(sequence);
  note_left_out(sequence);
  note_overshot(overshot, stops, sequence);
  if (odd.assumed_target != 0) {
    const double at_m = sequence.targets_m[static_cast<std::size_t>(odd.assumed_target) - 1];
    sequence.notices.push_back(
        notice(NoticeCode::end_target_assumed, "",
               {{"target", odd.assumed_target}, {"position_mm", to_mm(at_m)}}));
  }
  if (sequence.cycle == Cycle::none) sequence.notices.push_back(notice(NoticeCode::cycle_unknown));
  return sequence;
}

}  // namespace mdof::algo
