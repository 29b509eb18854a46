// Finds the stops at no target (leave_out_odd_stops() in sequence_stops.h). Criteria: the number of
// visits, visits from both sides, and the distance to the next targets, compared with the other
// places.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "algo/points/flags.h"
#include "algo/sequence/sequence_stops.h"

namespace mdof::algo {
namespace {

// Share of the typical number of visits; a place with more visits is certainly a target.
constexpr double kCertainTargetShare = 0.6;
// Places with at least this share of the typical number of visits determine the typical approaches.
constexpr double kTypicalVisitsShare = 0.75;
constexpr double kTooNear = 0.6;  // smallest distance to a target, in typical intervals
constexpr double kTooFar = 1.6;   // largest distance to the end target, in typical intervals
constexpr double kEvenInterval = 0.02, kSameInterval = 0.1;  // shares of the typical interval
constexpr std::size_t kFewest = 4;  // places necessary if all places have one visit
constexpr int kCertainVisits = 3;   // typical number of visits; see may_be_a_target()

// A place where the axis stopped.
struct Place {
  double position_m = 0;
  int forward = 0, reverse = 0;  // visits with an observed approach
  // The first stop of the log was here, and its approach was not observed: the axis may be parked.
  bool begins_here = false;
  bool first = false, last = false;  // an observed visit is the first, or the last, stop of the log
  bool kept = false;
  int visits() const { return forward + reverse; }
  bool is_parked() const { return begins_here && visits() == 0; }
};

struct Typical {
  double visits = 0;
  bool both_sides = false;
  int direction = 0;  // direction of all visits if they are from one side
  double interval_m = 0;
  bool is_even = false;  // all intervals are equal within kEvenInterval
};

std::vector<Place> places_of(const std::vector<MeasuredPoint>& points,
                             const std::vector<double>& targets_m) {
  std::vector<Place> places(targets_m.size());
  for (std::size_t t = 0; t < places.size(); ++t) places[t].position_m = targets_m[t];
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[static_cast<std::size_t>(points[i].target) - 1];
    place.last = place.last || i + 1 == points.size();
    if (i == 0 && has_flag(points[i].point, Flag::approach_assumed)) {
      place.begins_here = true;
      continue;
    }
    ++(points[i].point.direction > 0 ? place.forward : place.reverse);
    place.first = place.first || i == 0;
  }
  return places;
}

// Returns the upper quartile of the number of visits: for each stop, the number of visits of its
// place.
double typical_visits(const std::vector<Place>& places) {
  std::vector<int> of_stops;
  for (const Place& p : places)
    of_stops.insert(of_stops.end(), static_cast<std::size_t>(p.visits()), p.visits());
  if (of_stops.empty()) return 0;
  std::sort(of_stops.begin(), of_stops.end());
  return of_stops[(3 * of_stops.size() - 1) / 4];
}

bool is_certain_target(const Place& p, const Typical& typical) {
  const double enough = kCertainTargetShare * typical.visits;
  if (typical.both_sides) return p.visits() >= enough && p.forward > 0 && p.reverse > 0;
  return (typical.direction > 0 ? p.forward : p.reverse) >= enough;
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() / 2];
}

bool is_interval(double distance_m, const Typical& typical, double share) {
  return std::abs(distance_m - typical.interval_m) <= share * typical.interval_m;
}

Typical typical_of(std::vector<Place>& places) {
  Typical typical;
  typical.visits = typical_visits(places);
  int both = 0, one = 0, balance = 0;
  for (const Place& p : places) {
    if (p.visits() < kTypicalVisitsShare * typical.visits) continue;
    ++(p.forward > 0 && p.reverse > 0 ? both : one);
    balance += p.forward - p.reverse;
  }
  typical.both_sides = both >= one;
  typical.direction = balance >= 0 ? 1 : -1;
  std::vector<double> intervals;
  const Place* before = nullptr;
  for (Place& p : places) {
    p.kept = is_certain_target(p, typical);
    if (p.kept && before) intervals.push_back(p.position_m - before->position_m);
    if (p.kept) before = &p;
  }
  typical.interval_m = median(intervals);
  typical.is_even = intervals.size() + 1 >= kFewest &&
                    std::all_of(intervals.begin(), intervals.end(), [&](double interval_m) {
                      return is_interval(interval_m, typical, kEvenInterval);
                    });
  return typical;
}

struct Neighbours {
  // Distances to the next kept places.
  double below_m = std::numeric_limits<double>::infinity(), above_m = below_m;
  bool sure = false;  // the place directly before or after is a kept place
};

Neighbours neighbours(const std::vector<Place>& places, std::size_t at) {
  Neighbours found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == at || !places[i].kept) continue;
    const double d = places[at].position_m - places[i].position_m;
    (i < at ? found.below_m : found.above_m) =
        std::min(i < at ? found.below_m : found.above_m, std::abs(d));
  }
  found.sure = (at > 0 && places[at - 1].kept) || (at + 1 < places.size() && places[at + 1].kept);
  return found;
}

bool may_be_a_target(const Place& place, const Neighbours& n, const Typical& typical) {
  const double nearest_m = std::min(n.below_m, n.above_m);
  if (nearest_m < kTooNear * typical.interval_m) return false;
  const bool inside = std::isfinite(n.below_m) && std::isfinite(n.above_m);
  if (inside) return true;
  const bool once = place.visits() <= 1 && n.sure;
  if (once && (place.is_parked() || typical.visits >= kCertainVisits)) return false;
  // The axis was parked here before the first and after the last target.
  const bool at_ends_of_log = place.begins_here || place.last;
  if (once && at_ends_of_log && typical.both_sides && typical.is_even &&
      !is_interval(nearest_m, typical, kSameInterval))
    return false;
  return nearest_m <= kTooFar * typical.interval_m;
}

// Decides for each place that is not kept whether it may be a target. The places with the most
// visits are first. If places have the same number of visits, the nearest to a kept place is first,
// because targets with few visits continue the row of kept places.
void judge(std::vector<Place>& places, const Typical& typical) {
  std::vector<std::size_t> order;
  std::vector<double> distance(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].kept) continue;
    const Neighbours n = neighbours(places, i);
    distance[i] = std::min(n.below_m, n.above_m);
    order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (places[a].visits() != places[b].visits()) return places[a].visits() > places[b].visits();
    return distance[a] < distance[b];
  });
  for (const std::size_t i : order)
    places[i].kept = may_be_a_target(places[i], neighbours(places, i), typical);
}

// If all places have one visit, only a parked start with an unusual distance to the next place can
// be found.
void judge_start(std::vector<Place>& places) {
  const std::size_t n = places.size();
  if (n < kFewest) return;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < n; ++i)
    intervals.push_back(places[i].position_m - places[i - 1].position_m);
  const double typical_m = median(intervals);
  const auto off_grid = [&](double interval_m) {
    return interval_m < kTooNear * typical_m || interval_m > kTooFar * typical_m;
  };
  if (places.front().is_parked() && off_grid(intervals.front())) places.front().kept = false;
  if (places.back().is_parked() && off_grid(intervals.back())) places.back().kept = false;
}

// Returns whether the axis may only have been parked at this place, or turned there.
bool is_unsure(const Place& p) {
  return p.begins_here && (p.forward == 0 || p.reverse == 0);
}

// Returns the reason why a place is no target. The axis may stop anywhere before the first visit,
// after the last visit, and outside the end targets.
NoticeCode reason(const std::vector<Place>& places, std::size_t at, bool begins_log) {
  const Place& p = places[at];
  if (begins_log && p.begins_here) return NoticeCode::stop_parked_at_start;
  if (p.visits() == 1 && p.first) return NoticeCode::stop_before_first_target;
  if (p.visits() == 1 && p.last) return NoticeCode::stop_at_end_of_log;
  const auto kept = [](const Place& q) { return q.kept; };
  const auto here = places.begin() + static_cast<std::ptrdiff_t>(at);
  const bool inside =
      std::any_of(places.begin(), here, kept) && std::any_of(here, places.end(), kept);
  return inside ? NoticeCode::stop_between_targets : NoticeCode::stop_beyond_targets;
}

}  // namespace

OddStops leave_out_odd_stops(std::vector<MeasuredPoint>& points, std::vector<double>& targets_m) {
  std::vector<Place> places = places_of(points, targets_m);
  const Typical typical = typical_of(places);
  if (typical.visits <= 1) {
    for (Place& p : places) p.kept = true;
    judge_start(places);
  } else {
    if (!(typical.interval_m > 0)) return {};
    judge(places, typical);
  }
  std::vector<int> number(places.size(), 0);
  std::vector<double> kept_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].kept) continue;
    kept_m.push_back(targets_m[i]);
    number[i] = static_cast<int>(kept_m.size());
  }
  OddStops found;
  for (MeasuredPoint& p : points) {
    const auto at = static_cast<std::size_t>(p.target) - 1;
    p.target = number[at];
    if (p.target != 0) continue;
    found.left_out.push_back({p.point.position_m, p.point.begin_ns,
                              to_string(reason(places, at, &p == &points.front()))});
  }
  std::erase_if(points, [](const MeasuredPoint& p) { return p.target == 0; });
  targets_m = std::move(kept_m);
  for (std::size_t i = 0; typical.both_sides && typical.visits > 1 && i < places.size(); ++i)
    if (places[i].kept && is_unsure(places[i])) found.assumed_target = number[i];
  return found;
}

}  // namespace mdof::algo
