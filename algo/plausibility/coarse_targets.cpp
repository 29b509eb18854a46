#include "algo/plausibility/coarse_targets.h"

#include <array>
#include <cmath>
#include <set>
#include <string>

#include "algo/uncertainty/statistics/local_slopes.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestTargets = 5;
// Limit of the RMS slope between the targets / the RMS slope that the targets show. Waves with a
// length of 3.3 steps reach this limit.
constexpr double kLargestUnseen = 0.5;

// Sums over the inner targets, of one error.
struct SlopeSums {
  double seen = 0, unseen = 0, by_position = 0, noise = 0;

  bool is_coarse() const {
    return unseen > kLargestUnseen * kLargestUnseen * seen && by_position > noise;
  }
};

}  // namespace

Notices coarse_target_notices(const Rig& rig, const Run& run) {
  const double encoder_m = rig.uncertainty.encoder.u, scale = rig.expansion.scale.relative();
  std::set<int> targets;
  for (const MeasuredPoint& p : run.points) targets.insert(p.target);
  if (targets.size() < kFewestTargets) return {};
  std::array<SlopeSums, kErrorCount> sums;
  const std::vector<LocalSlope> slopes = local_slopes(run);
  for (std::size_t j = 0; j < slopes.size(); ++j) {
    const MeasuredPoint& p = run.points[j];
    const double position_m = std::hypot(encoder_m, scale * p.point.position_m);
    for (std::size_t e = 0; e < kErrorCount && p.errors.valid; ++e) {
      if (slopes[j].unseen[e] == 0) continue;
      sums[e].seen += std::pow(slopes[j].slope[e], 2);
      sums[e].unseen += std::pow(slopes[j].unseen[e], 2);
      sums[e].by_position += std::pow(position_m * slopes[j].unseen[e], 2);
      sums[e].noise += p.errors.covariance[(kErrorCount + 1) * e];
    }
  }
  std::string errors;
  for (const ErrorName& name : error_names(run.header.axis))
    if (sums[name.local].is_coarse())
      errors += (errors.empty() ? "" : ", ") + std::string(name.name);
  if (errors.empty()) return {};
  return {notice(NoticeCode::targets_too_coarse, "", {{"errors", errors}})};
}

}  // namespace mdof::algo
