#include "algo/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kMinStep_m = 2e-6;      // closer than this is one target whatever the ratio says
constexpr double kMaxScatter_m = 50e-6;  // wider than this is never one target
constexpr double kStepToScatter = 10;

// Largest distance between neighbours (sorted positions) that still belong to one target.
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
  // Every step small: all stops are at one target.
  if (!steps.empty() && steps.back() <= kMinStep_m) limit = steps.back();
  return limit;
}

// Where the axis first stopped for each target, ascending: it does not change as more stops come.
std::vector<double> recognised_targets(const std::vector<Point>& points) {
  std::vector<double> sorted;
  for (const Point& p : points) sorted.push_back(p.position_m);
  std::sort(sorted.begin(), sorted.end());
  const double limit = scatter_limit(sorted);
  std::vector<double> targets;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i] - sorted[i - 1] > limit) targets.push_back(sorted[i]);
  }
  std::vector<bool> named(targets.size(), false);
  std::vector<double> first = targets;
  for (const Point& p : points) {
    const auto above = std::upper_bound(targets.begin(), targets.end(), p.position_m);
    const auto t = static_cast<std::size_t>(above - targets.begin()) - 1;
    if (!named[t]) first[t] = p.position_m;
    named[t] = true;
  }
  return first;
}

std::size_t nearest(const std::vector<double>& targets, double position_m) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < targets.size(); ++i) {
    if (std::abs(targets[i] - position_m) < std::abs(targets[best] - position_m)) best = i;
  }
  return best;
}

std::string millimetres(double m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4f mm", to_mm(m));
  return text.data();
}

// Where the axis was before nobody saw it, it is taken to have stayed; elsewhere to be on its way
// to the next stop.
void assume_approaches(std::vector<MeasuredPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point& p = points[i].point;
    if (p.direction != 0) continue;
    const bool stayed = i > 0 && points[i - 1].target == points[i].target;
    const bool back = i + 1 < points.size() && points[i + 1].target < points[i].target;
    p.direction = stayed ? points[i - 1].point.direction : back ? -1 : 1;
    p.flags.emplace_back(kApproachAssumed);
  }
}

void merge_interrupted(std::vector<MeasuredPoint>& points) {
  std::vector<MeasuredPoint> merged;
  for (auto& p : points) {
    const bool again = !merged.empty() && merged.back().target == p.target &&
                       merged.back().point.direction == p.point.direction;
    if (!again) {
      merged.push_back(std::move(p));
      continue;
    }
    if (p.point.samples > merged.back().point.samples) merged.back() = std::move(p);
    auto& flags = merged.back().point.flags;
    if (std::find(flags.begin(), flags.end(), "interrupted") == flags.end()) {
      flags.emplace_back("interrupted");
    }
  }
  points = std::move(merged);
}

// Numbers the passes of each approach; gives the highest run number.
int number_runs(std::vector<MeasuredPoint>& points) {
  std::array<int, 2> passes{};
  int runs = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int direction = points[i].point.direction;
    const bool goes_on = i > 0 && points[i - 1].point.direction == direction &&
                         (points[i].target - points[i - 1].target) * direction > 0;
    int& pass = passes[direction > 0 ? 0 : 1];
    if (!goes_on) ++pass;
    points[i].run = pass;
    runs = std::max(runs, pass);
  }
  return runs;
}

}  // namespace

Sequence recognise_sequence(const std::vector<Point>& points, const SequenceOptions& options) {
  Sequence sequence;
  const bool nominal = !options.targets_m.empty();
  const std::vector<double> targets = nominal ? options.targets_m : recognised_targets(points);
  for (const Point& p : points) {
    const std::size_t t = targets.empty() ? 0 : nearest(targets, p.position_m);
    if (nominal && std::abs(targets[t] - p.position_m) > options.target_window_m) {
      sequence.warnings.push_back("a stop at " + millimetres(p.position_m) +
                                  " is near no target and was left out");
      continue;
    }
    MeasuredPoint m;
    m.target = static_cast<int>(t) + 1;
    m.target_m = targets[t];
    m.point = p;
    sequence.points.push_back(std::move(m));
  }
  assume_approaches(sequence.points);
  merge_interrupted(sequence.points);
  sequence.runs = number_runs(sequence.points);
  sequence.targets = static_cast<int>(targets.size());
  return sequence;
}

}  // namespace mdof::algo
