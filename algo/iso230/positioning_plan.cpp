// What ISO 230-2:2014, 5.3 asks of targets and runs.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "algo/iso230/positioning.h"
#include "schema/base/number/number_text.h"
#include "schema/targets.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLongest_m = 2;
constexpr double kTargetsPerMetre = 5;
constexpr std::size_t kFewestTargets = 5, kFewestRuns = 5;
constexpr double kEqualIntervals = 1e-3;  // of the mean interval

std::string millimetres_text(double m) {
  return plain_number(to_mm(m), 6) + " mm";
}

void tell_few_targets(const std::vector<double>& targets_m, std::vector<std::string>& warnings) {
  const double travel_m = targets_m.back() - targets_m.front();
  const auto per_travel = static_cast<std::size_t>(std::ceil(kTargetsPerMetre * travel_m));
  const std::size_t fewest = std::max(kFewestTargets, per_travel);
  if (targets_m.size() < fewest)
    warnings.push_back(std::to_string(targets_m.size()) + " targets over " +
                       millimetres_text(travel_m) + ": ISO 230-2 asks for at least five a metre " +
                       "and five in all, here " + std::to_string(fewest));
  if (travel_m > kLongest_m)
    warnings.push_back("the travel of " + millimetres_text(travel_m) +
                       " is over 2 m: ISO 230-2 has another test for such axes");
}

void tell_few_runs(const Positioning& p, std::vector<std::string>& warnings) {
  std::size_t least = p.targets[0].forward.n + p.targets[0].reverse.n, most = 0;
  bool one_way = false;
  for (const PositioningTarget& t : p.targets) {
    for (const std::size_t n : {t.forward.n, t.reverse.n}) {
      one_way |= n == 0;
      most = std::max(most, n);
      if (n > 0) least = std::min(least, n);
    }
  }
  if (one_way)
    warnings.push_back(
        "all targets were approached from one side only: B, R, E, M and A of both are not known");
  if (most == 1)
    warnings.push_back(
        "a single run: R and A are not known, for they need two runs, and ISO 230-2 asks for five "
        "each way; B, E and M are of that run alone");
  else if (least < kFewestRuns)
    warnings.push_back(std::to_string(least) + " runs" + (least < most ? " at some targets" : "") +
                       ": ISO 230-2 asks for at least five each way");
  if (least < most)
    warnings.push_back("the targets have from " + std::to_string(least) + " to " +
                       std::to_string(most) +
                       " readings from a side: each figure is of those that it has");
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

}  // namespace

std::vector<std::string> plan_warnings(const Positioning& p, double scale_period_m) {
  std::vector<double> targets_m;
  for (const PositioningTarget& t : p.targets) targets_m.push_back(t.target_m);
  std::vector<std::string> warnings;
  tell_few_targets(targets_m, warnings);
  tell_few_runs(p, warnings);
  const std::string periodic = periodic_warning(in_millimetres(targets_m), to_um(scale_period_m));
  if (!periodic.empty())
    warnings.push_back(periodic);
  else if (targets_m.size() > 2 && has_equal_intervals(targets_m))
    warnings.push_back(
        "all intervals between targets are equal, so that a periodic error may be the same at all "
        "of them; ISO 230-2 asks for intervals that differ");
  return warnings;
}

}  // namespace mdof::algo
