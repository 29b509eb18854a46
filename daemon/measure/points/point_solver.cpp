#include "daemon/measure/points/point_solver.h"

#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "daemon/measure/corrections/point_corrections.h"

namespace mdof::daemon {

std::vector<std::string> probe_ids(const Rig& rig) {
  std::vector<std::string> ids;
  for (const Probe& probe : rig.probes) ids.push_back(probe.id);
  return ids;
}

std::vector<double> probe_ranges_m(const Rig& rig) {
  std::vector<double> ranges_m;
  for (const Probe& probe : rig.probes) ranges_m.push_back(probe.range_m);
  return ranges_m;
}

void solve_point(const algo::Solver& solver, const Rig& rig, const algo::Residuals& residuals,
                 MeasuredPoint& p) {
  const double travel_m = rig.sides.target_travel_m(p.point.position_m);
  p.errors = solver.solve(travel_m, p.point.probe_m, p.point.probe_u_m);
  if (!p.errors.valid) p.errors.reason = cause_of(p.point) + p.errors.reason;
  residuals.test(p);
  p.errors = algo::restate(algo::errors_of_moving_body(p.errors, solver.model(), rig.moving()),
                           solver.model(), rig.moving(), travel_m, kAtCarriage, kAtFixture);
}

}  // namespace mdof::daemon
