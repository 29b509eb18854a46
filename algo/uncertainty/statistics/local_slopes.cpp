#include "algo/uncertainty/statistics/local_slopes.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace mdof::algo {
namespace {

constexpr double kOnePlaceShare = 0.02;  // relative to the mean step: targets at a smaller distance
                                         // are one place

// Mean travel and mean errors of several points.
struct Place {
  double travel_m = 0, points = 0;
  Errors5 errors{};

  void add(const Place& more) {
    const double share = more.points / (points += more.points);
    travel_m += share * (more.travel_m - travel_m);
    for (std::size_t e = 0; e < kErrorCount; ++e) errors[e] += share * (more.errors[e] - errors[e]);
  }
};

// Mean errors along the axis for one approach (direction 1 or -1), or for both approaches (0).
class ErrorCurve {
 public:
  ErrorCurve(const Run& run, int direction) {
    std::map<int, Place> targets;
    for (const MeasuredPoint& p : run.points)
      if (p.errors.valid && (direction == 0 || p.point.direction == direction))
        targets[p.target].add(
            {run.header.sides.target_travel_m(p.point.position_m), 1, p.errors.local});
    std::vector<Place> all;
    for (const auto& [target, place] : targets) all.push_back(place);
    join(std::move(all));
  }
  bool has_slope() const { return places_.size() > 1; }

  // Slope between the two neighbours of the place that is nearest to travel_m. At the first and
  // last place: slope between this place and its only neighbour.
  Errors5 slope_at(double travel_m) const {
    auto nearest =
        std::lower_bound(std::next(places_.begin()), std::prev(places_.end()), travel_m,
                         [](const Place& place, double at_m) { return place.travel_m < at_m; });
    if (travel_m - std::prev(nearest)->travel_m < nearest->travel_m - travel_m) --nearest;
    const Place& before = nearest == places_.begin() ? *nearest : *std::prev(nearest);
    const Place& behind = std::next(nearest) == places_.end() ? *nearest : *std::next(nearest);
    Errors5 slope{};
    for (std::size_t e = 0; e < kErrorCount; ++e)
      slope[e] = (behind.errors[e] - before.errors[e]) / (behind.travel_m - before.travel_m);
    return slope;
  }

 private:
  void join(std::vector<Place> all) {
    if (all.empty()) return;
    std::sort(all.begin(), all.end(),
              [](const Place& a, const Place& b) { return a.travel_m < b.travel_m; });
    const double range_m = all.back().travel_m - all.front().travel_m;
    const double apart_m = kOnePlaceShare * range_m / static_cast<double>(all.size());
    for (const Place& place : all) {
      if (places_.empty() || place.travel_m - places_.back().travel_m > apart_m)
        places_.push_back(place);
      else
        places_.back().add(place);
    }
  }
  std::vector<Place> places_;
};

}  // namespace

std::vector<Errors5> local_slopes(const Run& run) {
  const ErrorCurve both(run, 0), forward(run, 1), reverse(run, -1);
  std::vector<Errors5> slopes;
  slopes.reserve(run.points.size());
  for (const MeasuredPoint& p : run.points) {
    const ErrorCurve& own = p.point.direction > 0 ? forward : reverse;
    const ErrorCurve& curve = p.point.direction != 0 && own.has_slope() ? own : both;
    slopes.push_back(curve.has_slope()
                         ? curve.slope_at(run.header.sides.target_travel_m(p.point.position_m))
                         : Errors5{});
  }
  return slopes;
}

}  // namespace mdof::algo
