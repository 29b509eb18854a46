#include "algo/separation/run_series.h"

#include <algorithm>
#include <cmath>

#include "algo/iso230/target_changes.h"
#include "algo/iso230/target_means.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/statistics/common_quantities.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAcrossPlane = 0.5;  // cosine of the angle between a plane's normal and the axis
                                      // `normal`

// Replaces the first named error of each point by the reading of one probe. Then means and
// uncertainties are calculated by the usual functions. `along`: +1 if the probe measures in the +
// direction of the axis `normal`, otherwise -1.
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

// Changes of the means of one named error if the local errors of the points change by `shifts`.
std::vector<double> at_targets(const TargetChanges& changes, const std::vector<Errors5>& shifts,
                               std::size_t named) {
  std::vector<double> at;
  for (const Errors5& of_target : changes.of(shifts)) at.push_back(of_target[named]);
  return at;
}

// Text for DeclaredShift::common_as. Each part of a contributor is a separate quantity.
std::string name_of_part(const Contributor& contributor, std::size_t part) {
  return contributor.common_as.empty() ? "" : contributor.common_as + " " + std::to_string(part);
}

// Changes of the readings of one probe, as in with_reading(), by the declared sensitivity and drift
// of this probe.
Result<std::vector<DeclaredShift>> declared_probe_shifts(const Run& run, const Rig& rig,
                                                         std::size_t probe, double along) {
  MDOF_TRY(const auto declared, contributors(rig, run));
  const std::vector<MeasuredPoint> points = with_reading(run, probe, along);
  const TargetChanges changes(run.header.moving(), points);
  const std::int64_t start_ns = run.points.front().point.begin_ns;
  std::vector<DeclaredShift> shifts;
  for (const Contributor& c : declared) {
    const bool scale = c.name.kind == ContributorKind::probe_sensitivity;
    if (!scale && c.name.kind != ContributorKind::probe_drift) continue;
    if (c.name.subject != rig.probes[probe].id) continue;
    std::vector<Errors5> of_points;
    for (const MeasuredPoint& p : points) {
      Errors5 named = named_from_local(run.header.moving(), p.errors.local);
      named[0] = scale ? c.declared.u * named[0]
                       : run.header.sides.error_sign() * along * c.declared.u *
                             ns_to_s(p.point.begin_ns - start_ns);
      of_points.push_back(local_from_named(run.header.moving(), named));
    }
    shifts.push_back({name_of_part(c, 0), at_targets(changes, of_points, 0)});
  }
  return shifts;
}

}  // namespace

Result<std::vector<DeclaredShift>> declared_shifts(const Run& run, const Rig& rig,
                                                   std::size_t named, Axis normal) {
  MDOF_TRY(const auto declared, contributors(rig, run));
  std::vector<ContributorName> looked_at;
  for (const TargetPlane& plane : rig.planes)
    if (std::abs(plane.normal[static_cast<std::size_t>(normal)]) > kAcrossPlane)
      looked_at.push_back(flatness_name(rig, plane));
  const TargetChanges changes(run.header.moving(), run.points);
  std::vector<DeclaredShift> shifts;
  for (const Contributor& c : declared) {
    if (std::find(looked_at.begin(), looked_at.end(), c.name) != looked_at.end()) continue;
    const auto parts = c.parts();
    for (std::size_t part = 0; part < parts.size(); ++part)
      shifts.push_back({name_of_part(c, part), at_targets(changes, parts[part], named)});
  }
  return shifts;
}

SetUp error_series(const Run& run, std::size_t named) {
  return series_of(run, run.points, named);
}

Result<ProbeSeries> probe_series(const Run& run, const Rig& rig, const std::string& probe,
                                 Axis normal) {
  constexpr double kAcross = 1e-6;  // 1 - cosine of 1.4 mrad
  const auto index = rig.probe_index(probe);
  if (!index) {
    std::string ids;
    for (const Probe& p : rig.probes) ids += (ids.empty() ? "" : ", ") + p.id;
    return bad_input(rig.source + ": has no probe \"" + probe + "\"; the probes of this rig are " +
                     ids);
  }
  const Probe& found = rig.probes[*index];
  const double along = found.direction[static_cast<std::size_t>(normal)];
  if (std::abs(along) < 1 - kAcross)
    return bad_input(rig.source + ": probe \"" + probe + "\" does not measure along " +
                         letter(normal) + ", the normal of this surface",
                     Remedy::take_other_surface);
  const double sense = along > 0 ? 1.0 : -1.0;
  ProbeSeries series{series_of(run, with_reading(run, *index, sense), 0), found.position_m};
  MDOF_TRY(series.set_up.declared, declared_probe_shifts(run, rig, *index, sense));
  return series;
}

}  // namespace mdof::algo
