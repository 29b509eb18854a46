// Finds mistakes in the visits of a run: missing visits, visits that occur twice, targets that were
// found late, and stops without a point.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "algo/plausibility/plausibility.h"
#include "algo/sequence/ranges_text.h"
#include "algo/sequence/shifted_targets.h"
#include "algo/sequence/uneven_visits.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// A run with a longer travel should have more than one stop.
constexpr double kLeastTravelOfStops_m = 1e-3;

const char* approach(int direction) {
  return direction > 0 ? "forward" : "reverse";
}

// A visit of the matrix n_ij (run i, target j, for each direction).
struct Cell {
  int direction, run, target;
  bool operator<(const Cell& o) const {
    if (direction != o.direction) return direction > o.direction;
    return run != o.run ? run < o.run : target < o.target;
  }
};

struct Visits {
  std::map<Cell, int> seen;
  std::map<Cell, std::string> unsolved;  // reason
  std::set<int> directions, targets;
};

Visits visits_of(const Sequence& sequence) {
  Visits visits;
  std::set<Cell> solved;
  for (const MeasuredPoint& p : sequence.points) {
    const Cell cell{p.point.direction, p.run, p.target};
    ++visits.seen[cell];
    visits.directions.insert(cell.direction);
    visits.targets.insert(cell.target);
    if (p.errors.valid) solved.insert(cell);
    if (!p.errors.valid) visits.unsolved[cell] = p.errors.reason;
  }
  std::erase_if(visits.unsolved, [&](const auto& cell) { return solved.contains(cell.first); });
  return visits;
}

class MissingVisits {
 public:
  explicit MissingVisits(const RunToJudge& run)
      : sequence_(run.sequence), visits_(visits_of(sequence_)) {}

  Notices found() {
    Notices out;
    never_visited(out);
    // Visits that are missing because the log began or ended within a pass have a separate notice.
    Cells holes, beyond;
    for (const Cell& cell : missing()) (is_outside_log(cell) ? beyond : holes).push_back(cell);
    put(out, NoticeCode::visit_missing, holes);
    put(out, NoticeCode::visit_outside_log, beyond);
    Cells twice, unsolved;
    for (const auto& [cell, n] : visits_.seen)
      if (n > 1) twice.push_back(cell);
    for (const auto& [cell, why] : visits_.unsolved) unsolved.push_back(cell);
    put(out, NoticeCode::visit_doubled, twice);
    put(out, NoticeCode::visit_unsolved, unsolved);
    return out;
  }

 private:
  using Cells = std::vector<Cell>;

  void never_visited(Notices& out) const {
    std::vector<int> never;
    for (int t = 1; t <= sequence_.targets; ++t)
      if (!visits_.targets.contains(t)) never.push_back(t);
    if (!never.empty())
      out.push_back(
          notice(NoticeCode::target_never_visited, "", {{"targets", numbered("target", never)}}));
  }
  // Returns whether the cycle includes this visit. The end targets of a pendulum cycle are
  // approached from one side only.
  bool awaited(const Cell& cell) const {
    if (!visits_.directions.contains(cell.direction) || !visits_.targets.contains(cell.target))
      return false;
    if (sequence_.cycle != Cycle::pendulum) return true;
    return !(cell.direction > 0 && cell.target == 1) &&
           !(cell.direction < 0 && cell.target == sequence_.targets);
  }
  bool is_outside_log(const Cell& cell) const {
    if (!sequence_.by_passes) return false;
    const auto in_pass_of = [&](const MeasuredPoint& p) {
      return cell.run == p.run && cell.direction == p.point.direction;
    };
    const MeasuredPoint &first = sequence_.points.front(), &last = sequence_.points.back();
    if (in_pass_of(first) && (first.target - cell.target) * cell.direction > 0) return true;
    if (in_pass_of(last) && (cell.target - last.target) * cell.direction > 0) return true;
    const bool begun = std::any_of(visits_.seen.begin(), visits_.seen.end(), [&](const auto& v) {
      return v.first.run == cell.run && v.first.direction == cell.direction;
    });
    return !begun && cell.run == last.run && last.point.direction == first.point.direction;
  }
  Cells missing() const {
    Cells cells;
    for (const int direction : {1, -1}) {
      for (int run = 1; run <= sequence_.runs; ++run) {
        for (int t = 1; t <= sequence_.targets; ++t) {
          const Cell cell{direction, run, t};
          if (awaited(cell) && !visits_.seen.contains(cell)) cells.push_back(cell);
        }
      }
    }
    return cells;
  }
  // Adds one notice for each run and approach.
  void put(Notices& out, NoticeCode code, const Cells& cells) const {
    Notices alike;
    for (std::size_t i = 0; i < cells.size();) {
      std::vector<int> targets;
      const Cell first = cells[i];
      for (; i < cells.size() && cells[i].direction == first.direction && cells[i].run == first.run;
           ++i)
        targets.push_back(cells[i].target);
      const bool all =
          targets.size() == visits_.targets.size() && code != NoticeCode::visit_doubled;
      Notice here{code, severity(code), "", {{"run", first.run}}, ""};
      here.values.emplace_back("approach", approach(first.direction));
      here.values.emplace_back("targets", all ? "any target" : numbered("target", targets));
      if (code == NoticeCode::visit_unsolved)
        here.values.emplace_back("reason", visits_.unsolved.at(first));
      alike.push_back(std::move(here));
    }
    append_first(out, std::move(alike));
  }

  const Sequence& sequence_;
  Visits visits_;
};

// During a run, targets are numbered when they are visited for the first time. If the first pass
// misses a target, the numbers of the later targets increase by 1 when a later pass finds the
// missed target.
void note_found_late(const RunToJudge& run, Notices& out) {
  if (run.targets_given || !run.sequence.by_passes || run.sequence.points.empty()) return;
  const MeasuredPoint& start = run.sequence.points.front();
  std::set<int> first_pass, later;
  for (const MeasuredPoint& p : run.sequence.points) {
    const bool first = p.run == 1 && p.point.direction == start.point.direction;
    (first ? first_pass : later).insert(p.target);
  }
  std::vector<int> late;
  for (const int t : later)
    if (!first_pass.contains(t)) late.push_back(t);
  if (late.empty() || late.back() == run.sequence.targets || late.size() > first_pass.size())
    return;
  out.push_back(
      notice(NoticeCode::targets_renumbered, "", {{"targets", numbered("target", late)}}));
}

void note_lost_stops(const RunToJudge& run, Notices& out) {
  const auto lost = lost_stops(run);
  if (lost.empty()) return;
  std::size_t brief = 0;
  double longest_s = 0;
  for (const auto& stop : lost) {
    brief += stop.too_short;
    if (stop.too_short) longest_s = std::max(longest_s, stop.length_s);
  }
  out.push_back(notice(NoticeCode::visit_without_point, "",
                       {{"visits", lost.size()},
                        {"too_short", brief},
                        {"creeping", lost.size() - brief},
                        {"longest_s", longest_s},
                        {"needed_s", run.dwells.needed_s},
                        {"first_mm", to_mm(lost.front().position_m)}}));
}

// If more stops were left out than had no point, other notices state the cause.
void note_single_place(const RunToJudge& run, Notices& out) {
  std::set<int> places;
  for (const auto& p : run.sequence.points) places.insert(p.target);
  const double travel_m = run.dwells.encoder_max_m - run.dwells.encoder_min_m;
  const std::size_t others = run.dwells.passed_over.size();
  if (places.size() != 1 || travel_m < kLeastTravelOfStops_m ||
      run.sequence.left_out.size() > others)
    return;
  out.push_back(notice(NoticeCode::stops_at_one_place, "",
                       {{"position_mm", to_mm(run.sequence.points.front().target_m)},
                        {"travel_mm", to_mm(travel_m)},
                        {"others", others},
                        {"needed_s", run.dwells.needed_s},
                        {"tolerance_um", to_um(run.dwells.tolerance_m)}}));
}

void note_many_left_out(const RunToJudge& run, Notices& out) {
  const std::size_t kept = run.sequence.points.size(), left_out = run.sequence.left_out.size();
  if (left_out <= kept) return;
  out.push_back(notice(
      NoticeCode::most_stops_left_out, "",
      {{"left_out", left_out}, {"kept", kept}, {"targets_given", run.targets_given ? 1 : 0}}));
}

void note_shifted_targets(const RunToJudge& run, Notices& out) {
  const auto shifted = find_shifted_targets(run.sequence);
  if (!shifted) return;
  const std::int64_t begin_ns = run.sequence.points.front().point.begin_ns;
  out.push_back(notice(
      NoticeCode::targets_shifted, "",
      {{"time_s", ns_to_s(shifted->time_ns - begin_ns)}, {"shift_mm", to_mm(shifted->shift_m)}}));
}

void note_uneven(const RunToJudge& run, Notices& out) {
  std::vector<MeasuredPoint> points = run.sequence.points;
  if (run.sequence.cycle == Cycle::pendulum) {  // its end targets have one approach only
    std::erase_if(points, [&](const MeasuredPoint& p) {
      return p.target == 1 || p.target == run.sequence.targets;
    });
  }
  append(out, uneven_visits(points));
}

}  // namespace

Notices visit_notices(const RunToJudge& run) {
  Notices out;
  note_single_place(run, out);
  note_shifted_targets(run, out);
  note_many_left_out(run, out);
  if (run.sequence.cycle == Cycle::pendulum && run.sequence.runs <= 1)
    out.push_back(notice(NoticeCode::pendulum_assumed));
  append(out, MissingVisits(run).found());
  note_uneven(run, out);
  note_found_late(run, out);
  note_lost_stops(run, out);
  return out;
}

}  // namespace mdof::algo
