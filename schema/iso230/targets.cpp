#include "schema/iso230/targets.h"

#include <algorithm>

namespace mdof {

std::vector<double> distinct_targets(std::vector<double> positions_m) {
  std::sort(positions_m.begin(), positions_m.end());
  std::vector<double> targets;
  for (const double at : positions_m)
    if (targets.empty() || at - targets.back() > kSameTarget_m) targets.push_back(at);
  return targets;
}

std::size_t target_at(const std::vector<double>& targets_m, double position_m) {
  const auto above = std::lower_bound(targets_m.begin(), targets_m.end(), position_m);
  if (above == targets_m.begin()) return 0;
  const auto below = above - 1;
  const bool take_above = above != targets_m.end() && *above - position_m < position_m - *below;
  return static_cast<std::size_t>((take_above ? above : below) - targets_m.begin());
}

}  // namespace mdof
