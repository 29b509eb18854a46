#include "algo/plausibility/map_cover.h"

#include <algorithm>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLetPass_m = 50e-6;

struct Reach {
  double least_m = 0, most_m = 0;
};

// Of one probe over the plane, along one of its two axes of C. Which these are: as in rigid.cpp.
Reach reach_of(const FixtureProbe& probe, bool first, double least_m, double most_m) {
  Eigen::Index normal = 0;
  probe.n_C.cwiseAbs().maxCoeff(&normal);
  const Eigen::Index along = first ? (normal == 0 ? 1 : 0) : (normal == 2 ? 1 : 2);
  if (along > 0) return {probe.p_MP(along), probe.p_MP(along)};
  return {probe.p_MP.x() - most_m, probe.p_MP.x() - least_m};
}

std::string range_text(double from_m, double to_m) {
  const std::string from = plain_number(to_mm(from_m), 6);
  return from_m == to_m ? from + " mm" : from + " to " + plain_number(to_mm(to_m), 6) + " mm";
}

std::string gap_of(const TargetPlane& plane, std::size_t index, bool first, const Fixture& fixture,
                   double least_m, double most_m) {
  const std::vector<double>& covered = first ? plane.flatness.first_m : plane.flatness.second_m;
  if (covered.size() < 2) return "";
  std::string outside;
  for (const FixtureProbe& probe : fixture.probes) {
    if (probe.plane != index) continue;
    const Reach reach = reach_of(probe, first, least_m, most_m);
    if (reach.least_m >= covered.front() - kLetPass_m &&
        reach.most_m <= covered.back() + kLetPass_m)
      continue;
    outside += (outside.empty() ? "probe " : ", probe ") + probe.id + " reads at " +
               range_text(reach.least_m, reach.most_m);
  }
  if (outside.empty()) return "";
  return std::string(first ? "flatness_first_mm" : "flatness_second_mm") + " covers " +
         range_text(covered.front(), covered.back()) + ", and " + outside;
}

}  // namespace

std::vector<std::string> warnings_of_maps(const Rig& rig, const Fixture& fixture, double least_m,
                                          double most_m) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < rig.planes.size(); ++i) {
    if (rig.planes[i].flatness.empty()) continue;
    for (const bool first : {true, false}) {
      const std::string gap = gap_of(rig.planes[i], i, first, fixture, least_m, most_m);
      if (gap.empty()) continue;
      warnings.push_back("plane \"" + rig.planes[i].id +
                         "\": its height map does not cover what "
                         "is measured: " +
                         gap +
                         "; beyond it the height of its end is taken, which nobody measured; "
                         "extend the map, or keep the travel within it");
    }
  }
  return warnings;
}

std::vector<std::string> warnings_of_maps(const Rig& rig, const Fixture& fixture,
                                          const std::vector<MeasuredPoint>& points) {
  std::vector<double> travels_m;
  for (const MeasuredPoint& p : points)
    if (p.errors.valid) travels_m.push_back(rig.sides.target_travel_m(p.point.position_m));
  if (travels_m.empty()) return {};
  const auto [least, most] = std::minmax_element(travels_m.begin(), travels_m.end());
  return warnings_of_maps(rig, fixture, *least, *most);
}

}  // namespace mdof::algo
