#include "algo/uncertainty/statistics/local_slopes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace mdof::algo {
namespace {

// Relative to the mean step: targets at a smaller distance are one place.
constexpr double kOnePlaceShare = 0.02;
// Fitted to waves of 2.2 steps and more: with this factor, the root sum of squares of `slope` and
// `unseen` is 0.97 to 1.11 times the true slope.
constexpr double kUnseenShare = 0.6;
constexpr double kFewPlacesRoughness = 0.75;  // that of errors without any relation between targets

double square(double value) {
  return value * value;
}

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

  // Slopes at the place that is nearest to travel_m.
  LocalSlope slope_at(double travel_m) const {
    auto nearest =
        std::lower_bound(std::next(places_.begin()), std::prev(places_.end()), travel_m,
                         [](const Place& place, double at_m) { return place.travel_m < at_m; });
    if (travel_m - std::prev(nearest)->travel_m < nearest->travel_m - travel_m) --nearest;
    return slopes_[static_cast<std::size_t>(nearest - places_.begin())];
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
    slopes_.resize(places_.size());
    for (std::size_t e = 0; e < kErrorCount && has_slope(); ++e) {
      add_spline(e);
      const double unseen = std::sqrt(unseen_square(e));
      for (std::size_t i = 1; i + 1 < places_.size(); ++i) slopes_[i].unseen[e] = unseen;
    }
  }

  double step(std::size_t i) const { return places_[i + 1].travel_m - places_[i].travel_m; }
  double chord(std::size_t e, std::size_t from, std::size_t to) const {
    return (places_[to].errors[e] - places_[from].errors[e]) /
           (places_[to].travel_m - places_[from].travel_m);
  }

  // Slopes of the natural cubic spline, by elimination in the tridiagonal equations.
  void add_spline(std::size_t e) {
    const std::size_t last = places_.size() - 1;
    std::vector<double> diagonal(last + 1), right(last + 1);
    const auto above = [&](std::size_t i) { return i == 0 ? 1 : step(i - 1); };
    diagonal[0] = 2;
    right[0] = 3 * chord(e, 0, 1);
    for (std::size_t i = 1; i <= last; ++i) {
      const bool is_inner = i < last;
      const double below = is_inner ? step(i) : 1;
      diagonal[i] = is_inner ? 2 * (step(i - 1) + step(i)) : 2;
      right[i] = 3 * below * chord(e, i - 1, i);
      if (is_inner) right[i] += 3 * step(i - 1) * chord(e, i, i + 1);
      const double factor = below / diagonal[i - 1];
      diagonal[i] -= factor * above(i - 1);
      right[i] -= factor * right[i - 1];
    }
    slopes_[last].slope[e] = right[last] / diagonal[last];
    for (std::size_t i = last; i-- > 0;)
      slopes_[i].slope[e] = (right[i] - above(i) * slopes_[i + 1].slope[e]) / diagonal[i];
  }

  // Mean square of the changes of the chord from interval to interval. Each interval contains
  // `each` steps.
  double mean_square_bend(std::size_t e, std::size_t each) const {
    double sum = 0;
    const std::size_t count = places_.size() - 2 * each;
    for (std::size_t i = each; i < each + count; ++i)
      sum += square(chord(e, i, i + each) - chord(e, i - each, i));
    return sum / static_cast<double>(count);
  }

  // The roughness is sin²(π step/λ) for a wave of the length λ and 0 for a parabola.
  double unseen_square(std::size_t e) const {
    if (places_.size() < 3) return 0;
    const double bend = mean_square_bend(e, 1);
    if (bend == 0) return 0;
    const double roughness = places_.size() < 5
                                 ? kFewPlacesRoughness
                                 : std::max(0.0, 1 - std::sqrt(mean_square_bend(e, 2) / bend) / 2);
    return kUnseenShare * square(square(roughness)) * bend;
  }

  std::vector<Place> places_;
  std::vector<LocalSlope> slopes_;  // one for each place
};

}  // namespace

std::vector<LocalSlope> local_slopes(const Run& run) {
  const ErrorCurve both(run, 0), forward(run, 1), reverse(run, -1);
  std::vector<LocalSlope> slopes;
  slopes.reserve(run.points.size());
  for (const MeasuredPoint& p : run.points) {
    const ErrorCurve& own = p.point.direction > 0 ? forward : reverse;
    const ErrorCurve& curve = p.point.direction != 0 && own.has_slope() ? own : both;
    slopes.push_back(curve.has_slope()
                         ? curve.slope_at(run.header.sides.target_travel_m(p.point.position_m))
                         : LocalSlope{});
  }
  return slopes;
}

}  // namespace mdof::algo
