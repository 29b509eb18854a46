#include "algo/plausibility/calibrated_stretch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAllowedExcess = 0.1;  // as share of the calibrated range

// Returns the displacements at the ends of the calibrated range, um.
std::array<double, 2> displacements_um(const Calibration& c) {
  std::array<double, 2> ends_um = *c.calibrated_um;
  for (double& t_um : ends_um) t_um += linearity_um(c, t_um);
  if (c.reads_gap) ends_um = {-ends_um[1], -ends_um[0]};
  return ends_um;
}

}  // namespace

void widen(std::optional<ReadingSpan>& span, double reading_m) {
  if (!std::isfinite(reading_m)) return;
  if (!span) span = {reading_m, reading_m};
  span->least_m = std::min(span->least_m, reading_m);
  span->most_m = std::max(span->most_m, reading_m);
}

Notices calibrated_range_notices(const Rig& rig,
                                 const std::vector<std::optional<ReadingSpan>>& spans) {
  Notices found;
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const Calibration& c = rig.probes[k].calibration;
    if (!c.calibrated_um || !spans[k]) continue;
    const auto [begin_um, end_um] = displacements_um(c);
    const double allowed_excess_um = kAllowedExcess * (end_um - begin_um);
    const double least_um = to_um(spans[k]->least_m), most_um = to_um(spans[k]->most_m);
    if (least_um >= begin_um - allowed_excess_um && most_um <= end_um + allowed_excess_um) continue;
    found.push_back(notice(NoticeCode::beyond_calibration, rig.probes[k].id,
                           {{"from_um", least_um},
                            {"to_um", most_um},
                            {"calibrated_from_um", begin_um},
                            {"calibrated_to_um", end_um}}));
  }
  return found;
}

Notices calibrated_range_notices(const Rig& rig, const std::vector<MeasuredPoint>& points) {
  std::vector<std::optional<ReadingSpan>> spans(rig.probes.size());
  for (const MeasuredPoint& p : points)
    for (std::size_t k = 0; p.errors.valid && k < spans.size(); ++k)
      widen(spans[k], p.point.probe_m[k]);
  return calibrated_range_notices(rig, spans);
}

}  // namespace mdof::algo
