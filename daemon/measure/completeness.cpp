#include "daemon/measure/completeness.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kTargetsNamed = 6;

// Number of solved points of a target, for each approach.
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

Visits missing_visits(const Visits& visits, int repeats) {
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

// The most frequent reason why points were not solved.
std::string most_frequent_reason(const std::vector<MeasuredPoint>& points) {
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

// Returns text such as "target 2 at 2.000 mm: 1 reverse; ...; and 5 more targets".
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
  return more == 0 ? text
                   : text + "; and " + std::to_string(more) +
                         (more == 1 ? " more target" : " more targets");
}

std::optional<Notice> not_measured(const std::vector<double>& targets_m, int repeats,
                                   const std::vector<MeasuredPoint>& points) {
  std::vector<Visits> missing;
  int points_missing = 0;
  for (const Visits& visits : count_visits(targets_m.size(), points)) {
    missing.push_back(missing_visits(visits, repeats));
    points_missing += missing.back().forward + missing.back().reverse;
  }
  if (points_missing == 0) return std::nullopt;
  const std::size_t of = targets_m.size() * (repeats == 0 ? 1 : 2 * std::size_t(repeats));
  return notice(repeats == 0 ? NoticeCode::targets_missing : NoticeCode::points_missing, "",
                {{"missing", points_missing},
                 {"of", of},
                 {"targets", targets_text(targets_m, missing, repeats)}});
}

}  // namespace

bool all_measured(const std::vector<double>& targets_m, int repeats,
                  const std::vector<MeasuredPoint>& points) {
  if (repeats == 0) return false;
  const auto visits = count_visits(targets_m.size(), points);
  return std::all_of(visits.begin(), visits.end(),
                     [&](const Visits& v) { return v.forward >= repeats && v.reverse >= repeats; });
}

Notices missing_notices(const std::vector<double>& targets_m, int repeats,
                        const std::vector<MeasuredPoint>& points) {
  Notices found;
  if (auto missing = not_measured(targets_m, repeats, points)) found.push_back(std::move(*missing));
  const std::size_t unsolved = count_unsolved(points);
  if (2 * unsolved > points.size() || (!found.empty() && unsolved > 0))
    found.push_back(notice(NoticeCode::points_unsolved, "",
                           {{"unsolved", unsolved},
                            {"points", points.size()},
                            {"reason", most_frequent_reason(points)}}));
  return found;
}

}  // namespace mdof::daemon
