#include "algo/uncertainty/effects/plane_footprints.h"

#include <map>

namespace mdof::algo {

PlaneFootprints plane_footprints(const Rig& rig, const Fixture& fixture, const Run& run,
                                 const std::vector<PointSensitivity>& points, std::size_t plane) {
  const TargetPlane& surface = rig.planes[plane];
  PlaneFootprints out;
  out.u_m = surface.u_flatness.u;
  out.length_m = surface.flatness_length_m;
  out.points = points.size();
  struct Travel {
    double sum_m = 0, visits = 0;
    std::size_t footprint = 0;
  };
  std::map<int, Travel> travels;  // by target
  for (std::size_t j = 0; j < points.size(); ++j)
    if (points[j].valid) {
      Travel& at = travels[run.points[j].target];
      at.sum_m += points[j].travel_m;
      at.visits += 1;
    }
  for (std::size_t k = 0; k < fixture.probes.size(); ++k) {
    const FixtureProbe& probe = fixture.probes[k];
    if (probe.plane != plane) continue;
    for (auto& [target, at] : travels) {
      at.footprint = out.footprints.size();
      const double travel_m = at.sum_m / at.visits;
      out.footprints.push_back({probe.p_MP - travel_m * Eigen::Vector3d::UnitX(), probe.p_MP});
    }
    const double reading = 1 / probe.n_C.dot(probe.u_M);
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (!points[j].valid) continue;
      Errors5 by_height = points[j].by_probe[k];
      for (double& of_error : by_height) of_error *= reading;
      out.readings.push_back({j, travels.at(run.points[j].target).footprint, by_height});
    }
  }
  return out;
}

}  // namespace mdof::algo
