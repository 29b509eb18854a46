#include "algo/separation/run_series.h"

#include <cmath>

#include "algo/iso230/target_means.h"

namespace mdof::algo {
namespace {

// The points with a probe's reading in the place of the first named error, so that means and
// uncertainties are those of every other figure. `along`: of the reading, +1 or -1.
std::vector<MeasuredPoint> with_reading(const Run& run, std::size_t probe, double along) {
  const MovingAxis moving = run.header.moving();
  const auto local = static_cast<std::size_t>(error_names(moving.axis)[0].local);
  std::vector<MeasuredPoint> points = run.points;
  for (MeasuredPoint& p : points) {
    p.errors.valid = probe < p.point.probe_m.size() && std::isfinite(p.point.probe_m[probe]);
    if (!p.errors.valid) continue;
    Errors5 named{};
    named[0] = moving.sides.error_sign() * along * p.point.probe_m[probe];
    p.errors.local = local_from_named(moving, named);
    p.errors.covariance = {};
    p.errors.covariance[6 * local] = p.point.probe_u_m[probe] * p.point.probe_u_m[probe];
  }
  return points;
}

SetUp series_of(const Run& run, const std::vector<MeasuredPoint>& points, std::size_t named) {
  SetUp set_up;
  for (const TargetMean& mean : target_means(run.header.moving(), points, Approach::both)) {
    set_up.position_m.push_back(mean.position_m);
    set_up.error_m.push_back(mean.named[named]);
    set_up.u_m.push_back(mean.u[named]);
  }
  return set_up;
}

}  // namespace

SetUp error_series(const Run& run, std::size_t named) {
  return series_of(run, run.points, named);
}

Result<ProbeSeries> probe_series(const Run& run, const Rig& rig, const std::string& probe,
                                 Axis normal) {
  constexpr double kAcross = 1e-6;  // 1.4 mrad
  const auto index = rig.probe_index(probe);
  if (!index) {
    std::string ids;
    for (const Probe& p : rig.probes) ids += (ids.empty() ? "" : ", ") + p.id;
    return bad_input(rig.source + ": has no probe \"" + probe + "\" but " + ids);
  }
  const Probe& found = rig.probes[*index];
  const double along = found.direction[static_cast<std::size_t>(normal)];
  if (std::abs(along) < 1 - kAcross)
    return bad_input(rig.source + ": probe \"" + probe + "\" does not look along " +
                     letter(normal) + ", across this surface; take one that does, or the other " +
                     "--surface");
  return ProbeSeries{series_of(run, with_reading(run, *index, along > 0 ? 1.0 : -1.0), 0),
                     found.position_m};
}

}  // namespace mdof::algo
