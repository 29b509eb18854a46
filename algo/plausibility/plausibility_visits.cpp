// What is wrong with the visits of a run: holes, doubles, targets found late, stops without a
// point.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "algo/plausibility/plausibility.h"
#include "algo/plausibility/sentences.h"
#include "algo/points/ranges_text.h"
#include "algo/sequence/shifted_targets.h"
#include "algo/sequence/uneven_visits.h"
#include "schema/severity.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostNamed = 6;     // sentences of one kind; more are put together
constexpr double kWorthATravel_m = 1e-3;  // over which there should be more than one stop

std::string plural(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

const char* approach(int direction) {
  return direction > 0 ? "forward" : "reverse";
}

// A place in the matrix n_ij.
struct Cell {
  int direction, run, target;
  bool operator<(const Cell& o) const {
    if (direction != o.direction) return direction > o.direction;
    return run != o.run ? run < o.run : target < o.target;
  }
};

struct Visits {
  std::map<Cell, int> seen;
  std::map<Cell, std::string> unsolved;  // why
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

class Holes {
 public:
  explicit Holes(const RunToJudge& run) : sequence_(run.sequence), visits_(visits_of(sequence_)) {}

  Texts told() {
    Texts out;
    never_visited(out);
    // What the log does not have because it began or ended in the midst of a pass, nobody missed.
    Cells holes, beyond;
    for (const Cell& cell : missing()) (beyond_the_log(cell) ? beyond : holes).push_back(cell);
    put(out, holes, &Holes::missing_text, "no visit at");
    Texts known;
    put(known, beyond, &Holes::missing_text, "no visit at");
    for (const std::string& text : known) out.push_back(information(text));
    Cells twice, unsolved;
    for (const auto& [cell, n] : visits_.seen)
      if (n > 1) twice.push_back(cell);
    for (const auto& [cell, why] : visits_.unsolved) unsolved.push_back(cell);
    put(out, twice, &Holes::doubled_text, "more than one visit at");
    put(out, unsolved, &Holes::unsolved_text, "not solved at");
    return out;
  }

 private:
  using Cells = std::vector<Cell>;

  std::string name(int target) const {
    return "target " + std::to_string(target) + " (" +
           with_number("%.4f mm",
                       to_mm(sequence_.targets_m[static_cast<std::size_t>(target) - 1])) +
           ")";
  }
  void never_visited(Texts& out) const {
    std::vector<int> never;
    for (int t = 1; t <= sequence_.targets; ++t)
      if (!visits_.targets.contains(t)) never.push_back(t);
    if (never.size() == 1) out.push_back(name(never[0]) + " was never visited");
    if (never.size() > 1)
      out.push_back(plural(never.size(), "target") + " were never visited: " + ranges_text(never));
  }
  // The end targets of a pendulum cycle are come to from one side.
  bool awaited(const Cell& cell) const {
    if (!visits_.directions.contains(cell.direction) || !visits_.targets.contains(cell.target))
      return false;
    if (sequence_.cycle != Cycle::pendulum) return true;
    return !(cell.direction > 0 && cell.target == 1) &&
           !(cell.direction < 0 && cell.target == sequence_.targets);
  }
  bool beyond_the_log(const Cell& cell) const {
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
  std::string missing_text(const Cell& c) const {
    const std::string in = sequence_.by_passes ? "no " + std::string(approach(c.direction)) +
                                                     " visit in run " + std::to_string(c.run)
                                               : "no " + std::to_string(c.run) + ". visit " +
                                                     (c.direction > 0 ? "forward" : "in reverse");
    return name(c.target) + ": " + in;
  }
  std::string doubled_text(const Cell& c) const {
    return name(c.target) + ": " + std::to_string(visits_.seen.at(c)) + " " +
           approach(c.direction) + " visits in run " + std::to_string(c.run) +
           "; both count for its mean";
  }
  std::string unsolved_text(const Cell& c) const {
    return name(c.target) + ": the " + approach(c.direction) + " visit in run " +
           std::to_string(c.run) + " gave no errors (" + visits_.unsolved.at(c) + ")";
  }
  // Each by itself, or by run and approach where there are many.
  void put(Texts& out, const Cells& cells, std::string (Holes::*single)(const Cell&) const,
           const char* many) {
    if (cells.size() <= kMostNamed) {
      for (const Cell& cell : cells) out.push_back((this->*single)(cell));
      return;
    }
    Texts groups;
    for (std::size_t i = 0; i < cells.size();) {
      std::vector<int> targets;
      const Cell first = cells[i];
      for (; i < cells.size() && cells[i].direction == first.direction && cells[i].run == first.run;
           ++i)
        targets.push_back(cells[i].target);
      const bool all = targets.size() == visits_.targets.size();
      groups.push_back("run " + std::to_string(first.run) + ", " + approach(first.direction) +
                       ": " + many + " " + (all ? "any target" : numbered("target", targets)));
    }
    const std::size_t shown = std::min(groups.size(), kMostNamed);
    out.insert(out.end(), groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(shown));
    if (shown < groups.size())
      out.push_back("and " + plural(groups.size() - shown, "more run") + " with " + many +
                    " some targets: see n_ij");
  }

  const Sequence& sequence_;
  Visits visits_;
};

// While a run goes on, the targets seen so far are numbered; one that is missed at first shifts
// those after it.
void tell_found_late(const RunToJudge& run, Texts& out) {
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
      information(numbered("target", late) +
                  " found only after the first pass: the numbers of the targets above changed then "
                  "(give targets_mm to fix them)"));
}

void tell_lost_stops(const RunToJudge& run, Texts& out) {
  const auto lost = lost_stops(run);
  if (lost.empty()) return;
  std::size_t brief = 0;
  double longest_s = 0;
  for (const auto& stop : lost) {
    brief += stop.too_short;
    if (stop.too_short) longest_s = std::max(longest_s, stop.length_s);
  }
  std::string why;
  if (brief > 0)
    why = plural(brief, "stop") + " too short (up to " + with_number("%.3f s", longest_s) +
          ", needed " + with_number("%.3f s", run.least_dwell_s) + ")";
  if (brief < lost.size()) {
    why += why.empty() ? "" : ", ";
    why += plural(lost.size() - brief, "stop") + " creeping";
  }
  out.push_back(plural(lost.size(), "visit") + " of targets gave no point: " + why + "; first at " +
                with_number("%.4f mm", to_mm(lost.front().position_m)) +
                "; dwell longer, or change --settle-s, --min-length-s or --tolerance-um");
}

void tell_single_place(const RunToJudge& run, Texts& out) {
  std::set<int> places;
  for (const auto& p : run.sequence.points) places.insert(p.target);
  const double travel_m = run.dwells.encoder_max_m - run.dwells.encoder_min_m;
  if (places.size() != 1 || travel_m < kWorthATravel_m) return;
  out.push_back("stops were found at one place only (" +
                with_number("%.4f mm", to_mm(run.sequence.points.front().target_m)) +
                ") although " + with_number("the axis travels %.3f mm: ", to_mm(travel_m)) +
                plural(run.dwells.passed_over.size(), "other stop") +
                " were too short or crept, needed are " + with_number("%.3f s", run.least_dwell_s) +
                with_number(" within %.3g um", to_um(run.dwells.tolerance_m)) +
                "; dwell longer, or change --settle-s, --min-length-s or --tolerance-um");
}

void tell_many_left_out(const RunToJudge& run, Texts& out) {
  const std::size_t kept = run.sequence.points.size(), out_of = run.sequence.left_out.size();
  if (out_of <= kept) return;
  out.push_back("more stops were left out (" + std::to_string(out_of) + ") than kept (" +
                std::to_string(kept) + "): check " +
                (run.targets_given ? "targets_mm, their unit and the encoder's zero"
                                   : "the list of what was left out, or give targets_mm"));
}

void tell_shifted_targets(const RunToJudge& run, Texts& out) {
  const auto shifted = find_shifted_targets(run.sequence);
  if (!shifted) return;
  const std::int64_t begin_ns = run.sequence.points.front().point.begin_ns;
  out.push_back(invalid(
      with_number("%.3f s after the first stop began ", ns_to_s(shifted->time_ns - begin_ns)) +
      with_number("all targets lie %+.4f mm further: ", to_mm(shifted->shift_m)) +
      "the encoder's count jumped, its datum was set anew, or the axis was sent elsewhere; "
      "positions before and after do not belong together, measure again"));
}

void tell_one_turn(const RunToJudge& run, Texts& out) {
  if (run.sequence.cycle != Cycle::pendulum || run.sequence.runs > 1) return;
  out.push_back(information(
      "the axis turned at its end target, which has a visit from one side only: taken for a "
      "pendulum cycle; to have both, let the axis run beyond the end targets"));
}

void tell_uneven(const RunToJudge& run, Texts& out) {
  std::vector<MeasuredPoint> points = run.sequence.points;
  if (run.sequence.cycle == Cycle::pendulum) {  // whose end targets have one approach by design
    std::erase_if(points, [&](const MeasuredPoint& p) {
      return p.target == 1 || p.target == run.sequence.targets;
    });
  }
  const std::string uneven = uneven_visits_text(points);
  if (!uneven.empty()) out.push_back(uneven);
}

}  // namespace

std::vector<std::string> warnings_of_visits(const RunToJudge& run, const Plausibility&) {
  Texts out;
  tell_single_place(run, out);
  tell_shifted_targets(run, out);
  tell_many_left_out(run, out);
  tell_one_turn(run, out);
  const Texts holes = Holes(run).told();
  out.insert(out.end(), holes.begin(), holes.end());
  tell_uneven(run, out);
  tell_found_late(run, out);
  tell_lost_stops(run, out);
  return out;
}

}  // namespace mdof::algo
