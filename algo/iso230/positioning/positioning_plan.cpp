// Checks the requirements of ISO 230-2:2014, 5.3 for targets and runs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "algo/iso230/line_fit.h"
#include "algo/iso230/positioning/positioning.h"
#include "schema/base/number/number_text.h"
#include "schema/targets.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLongest_m = 2;
constexpr double kTargetsPerMetre = 5;
constexpr std::size_t kFewestTargets = 5, kFewestRuns = 5;
constexpr double kEqualIntervals = 1e-3;  // share of the mean interval

void judge_targets(const std::vector<double>& targets_m, Notices& found) {
  const double travel_m = targets_m.back() - targets_m.front();
  const auto per_travel = static_cast<std::size_t>(std::ceil(kTargetsPerMetre * travel_m));
  const std::size_t fewest = std::max(kFewestTargets, per_travel);
  if (targets_m.size() < fewest)
    found.push_back(notice(
        NoticeCode::few_targets, "",
        {{"targets", targets_m.size()}, {"travel_mm", to_mm(travel_m)}, {"needed", fewest}}));
  if (travel_m > kLongest_m)
    found.push_back(notice(NoticeCode::travel_over_2_m, "", {{"travel_mm", to_mm(travel_m)}}));
}

void judge_runs(const Positioning& p, Notices& found) {
  std::size_t least = p.targets[0].forward.n + p.targets[0].reverse.n, most = 0;
  bool one_way = false;
  for (const PositioningTarget& t : p.targets) {
    for (const std::size_t n : {t.forward.n, t.reverse.n}) {
      one_way |= n == 0;
      most = std::max(most, n);
      if (n > 0) least = std::min(least, n);
    }
  }
  if (one_way) found.push_back(notice(NoticeCode::one_approach));
  if (most == 1)
    found.push_back(notice(NoticeCode::single_run));
  else if (least < kFewestRuns)
    found.push_back(notice(NoticeCode::few_runs, "",
                           {{"runs", least}, {"some_targets", least < most ? 1 : 0}}));
  if (least < most)
    found.push_back(notice(NoticeCode::uneven_readings, "", {{"least", least}, {"most", most}}));
}

bool has_equal_intervals(const std::vector<double>& targets_m) {
  double shortest = targets_m.back() - targets_m.front(), longest = 0;
  const double mean = shortest / static_cast<double>(targets_m.size() - 1);
  for (std::size_t i = 1; i < targets_m.size(); ++i) {
    shortest = std::min(shortest, targets_m[i] - targets_m[i - 1]);
    longest = std::max(longest, targets_m[i] - targets_m[i - 1]);
  }
  return longest - shortest <= kEqualIntervals * mean;
}

std::vector<double> in_millimetres(std::vector<double> targets_m) {
  for (double& t : targets_m) t = to_mm(t);
  return targets_m;
}

// Mean of the approaches that have readings.
double mean_deviation(const PositioningTarget& t) {
  return t.forward.n == 0 ? t.reverse.mean : t.reverse.n == 0 ? t.forward.mean : t.mean;
}

// Slope of the least-squares line of the deviations over the targets; 0: only one target.
double slope_over_targets(const Positioning& p) {
  std::vector<double> target_m, deviation_m;
  for (const PositioningTarget& t : p.targets) {
    target_m.push_back(t.target_m);
    deviation_m.push_back(mean_deviation(t));
  }
  return can_fit(target_m) ? least_squares_line(target_m, deviation_m).slope : 0;
}

}  // namespace

Notices plan_notices(const Positioning& p, double scale_period_m) {
  std::vector<double> targets_m;
  for (const PositioningTarget& t : p.targets) targets_m.push_back(t.target_m);
  Notices found;
  judge_targets(targets_m, found);
  judge_runs(p, found);
  if (auto periodic = scale_period_notice(in_millimetres(targets_m), to_um(scale_period_m)))
    found.push_back(std::move(*periodic));
  else if (targets_m.size() > 2 && has_equal_intervals(targets_m))
    found.push_back(notice(NoticeCode::equal_intervals));
  return found;
}

Notices slope_notices(const Positioning& p) {
  constexpr double kOfPositions = 0.5, kOfMmAsUm = 1e-3, kSame = 0.05;
  const double slope = slope_over_targets(p), size = std::abs(slope);
  if (!(size > kOfPositions) && !(std::abs(size - kOfMmAsUm) <= kSame * kOfMmAsUm)) return {};
  return {notice(NoticeCode::deviations_follow_targets, "",
                 {{"slope_um_per_mm", to_um(slope) / to_mm(1)}})};
}

}  // namespace mdof::algo
