#include "algo/plausibility/map_cover.h"

#include <algorithm>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAllowedOutside_m = 50e-6;

struct Reach {
  double least_m = 0, most_m = 0;
};

// Returns the range that one probe measures on the plane along one of the two axes of the frame C
// that are in the plane, as in rigid.cpp.
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

// Returns a text with the probes that measure outside the map, "probe A reads at 1 to 2 mm, ...";
// empty: no probe does so.
std::string probes_outside_map(std::size_t plane, const std::vector<double>& covered_m, bool first,
                               const Fixture& fixture, double least_m, double most_m) {
  std::string outside;
  for (const FixtureProbe& probe : fixture.probes) {
    if (probe.plane != plane) continue;
    const Reach reach = reach_of(probe, first, least_m, most_m);
    if (reach.least_m >= covered_m.front() - kAllowedOutside_m &&
        reach.most_m <= covered_m.back() + kAllowedOutside_m)
      continue;
    outside += (outside.empty() ? "probe " : ", probe ") + probe.id + " reads at " +
               range_text(reach.least_m, reach.most_m);
  }
  return outside;
}

}  // namespace

Notices map_notices(const Rig& rig, const Fixture& fixture, double least_m, double most_m) {
  Notices found;
  for (std::size_t i = 0; i < rig.planes.size(); ++i) {
    const auto& map = rig.planes[i].flatness;
    for (const bool first : {true, false}) {
      const std::vector<double>& covered_m = first ? map.first_m : map.second_m;
      if (map.empty() || covered_m.size() < 2) continue;
      const std::string outside = probes_outside_map(i, covered_m, first, fixture, least_m, most_m);
      if (outside.empty()) continue;
      found.push_back(notice(NoticeCode::map_too_short, rig.planes[i].id,
                             {{"coordinate", first ? "flatness_first_mm" : "flatness_second_mm"},
                              {"covered_from_mm", to_mm(covered_m.front())},
                              {"covered_to_mm", to_mm(covered_m.back())},
                              {"reached", outside}}));
    }
  }
  return found;
}

Notices map_notices(const Rig& rig, const Fixture& fixture,
                    const std::vector<MeasuredPoint>& points) {
  std::vector<double> travels_m;
  for (const MeasuredPoint& p : points)
    if (p.errors.valid) travels_m.push_back(rig.sides.target_travel_m(p.point.position_m));
  if (travels_m.empty()) return {};
  const auto [least, most] = std::minmax_element(travels_m.begin(), travels_m.end());
  return map_notices(rig, fixture, *least, *most);
}

}  // namespace mdof::algo
