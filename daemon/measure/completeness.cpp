#include "daemon/measure/completeness.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kTargetsNamed = 6;

// Solved points of a target.
struct Visits {
  int forward = 0, reverse = 0;
};

std::vector<Visits> count_visits(std::size_t targets, const std::vector<MeasuredPoint>& points) {
  std::vector<Visits> visits(targets);
  for (const MeasuredPoint& p : points) {
    const auto target = static_cast<std::size_t>(p.target) - 1;
    if (!p.errors.valid || target >= targets) continue;
    ++(p.point.direction > 0 ? visits[target].forward : visits[target].reverse);
  }
  return visits;
}

Visits still_to_come(const Visits& visits, int repeats) {
  if (repeats == 0) return {visits.forward + visits.reverse > 0 ? 0 : 1, 0};
  return {std::max(0, repeats - visits.forward), std::max(0, repeats - visits.reverse)};
}

std::string target_text(std::size_t target, double target_m) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "target %zu at %.3f mm", target + 1, to_mm(target_m));
  return text.data();
}

std::string visits_text(const Visits& missing) {
  std::string text;
  if (missing.forward > 0) text += std::to_string(missing.forward) + " forward";
  if (missing.reverse > 0)
    text += (text.empty() ? "" : ", ") + std::to_string(missing.reverse) + " reverse";
  return text;
}

// The reason that most of the unsolved points give.
std::string commonest_reason(const std::vector<MeasuredPoint>& points) {
  std::map<std::string, int> count;
  for (const MeasuredPoint& p : points)
    if (!p.errors.valid) ++count[p.errors.reason];
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(count.begin(), count.end(), fewer)->first;
}

std::size_t count_unsolved(const std::vector<MeasuredPoint>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const auto& p) { return !p.errors.valid; }));
}

std::string unsolved_text(const std::vector<MeasuredPoint>& points) {
  const std::size_t unsolved = count_unsolved(points);
  return std::to_string(unsolved) + " of " + std::to_string(points.size()) +
         " points could not be solved" +
         (unsolved == 0 ? "" : ", most of them because: " + commonest_reason(points));
}

// "target 2 at 2.000 mm: 1 reverse; ...; and 5 more targets"
std::string targets_text(const std::vector<double>& targets_m, const std::vector<Visits>& missing,
                         int repeats) {
  std::string text;
  std::size_t named = 0, more = 0;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (missing[i].forward + missing[i].reverse == 0) continue;
    if (++named > kTargetsNamed) {
      ++more;
      continue;
    }
    text += (text.empty() ? "" : "; ") + target_text(i, targets_m[i]);
    if (repeats > 0) text += ": " + visits_text(missing[i]);
  }
  return more == 0 ? text : text + "; and " + std::to_string(more) + " more targets";
}

// The targets of which something is missing; empty: none.
std::string missing_text(const std::vector<double>& targets_m, int repeats,
                         const std::vector<MeasuredPoint>& points) {
  std::vector<Visits> missing;
  int points_missing = 0;
  for (const Visits& visits : count_visits(targets_m.size(), points)) {
    missing.push_back(still_to_come(visits, repeats));
    points_missing += missing.back().forward + missing.back().reverse;
  }
  if (points_missing == 0) return "";
  const std::size_t of = targets_m.size() * (repeats == 0 ? 1 : 2 * std::size_t(repeats));
  return std::to_string(points_missing) + " of " + std::to_string(of) +
         (repeats == 0 ? " targets were never measured: " : " points asked for are missing: ") +
         targets_text(targets_m, missing, repeats);
}

}  // namespace

bool all_measured(const std::vector<double>& targets_m, int repeats,
                  const std::vector<MeasuredPoint>& points) {
  if (repeats == 0) return false;
  const auto visits = count_visits(targets_m.size(), points);
  return std::all_of(visits.begin(), visits.end(),
                     [&](const Visits& v) { return v.forward >= repeats && v.reverse >= repeats; });
}

std::vector<std::string> what_is_missing(const std::vector<double>& targets_m, int repeats,
                                         const std::vector<MeasuredPoint>& points) {
  std::vector<std::string> reasons;
  const std::string missing = missing_text(targets_m, repeats, points);
  if (!missing.empty()) reasons.push_back(missing);
  const std::size_t unsolved = count_unsolved(points);
  const bool most = 2 * unsolved > points.size();
  if (most || (!missing.empty() && unsolved > 0)) reasons.push_back(unsolved_text(points));
  return reasons;
}

}  // namespace mdof::daemon
