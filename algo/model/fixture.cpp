#include "algo/model/fixture.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

Eigen::Vector3d local_vector(Axis axis, const Vec3& v) {
  const Vec3 l = to_local(axis, v);
  return {l[0], l[1], l[2]};
}

struct Cell {
  std::size_t index;
  double fraction;
};

Cell cell_of(const std::vector<double>& grid, double x) {
  if (grid.size() == 1 || x <= grid.front()) return {0, 0.0};
  if (x >= grid.back()) return {grid.size() - 2, 1.0};
  const auto upper = std::upper_bound(grid.begin(), grid.end(), x);
  const auto i = static_cast<std::size_t>(upper - grid.begin()) - 1;
  return {i, (x - grid[i]) / (grid[i + 1] - grid[i])};
}

double cosine(const TargetPlane& plane, const Probe& probe) {
  return std::abs(plane.normal[0] * probe.direction[0] + plane.normal[1] * probe.direction[1] +
                  plane.normal[2] * probe.direction[2]);
}

std::string ids_of(const Rig& rig) {
  std::string ids;
  for (const auto& plane : rig.planes) ids += (ids.empty() ? "\"" : ", \"") + plane.id + "\"";
  return ids;
}

Result<const TargetPlane*> named_plane(const Rig& rig, const Probe& probe) {
  for (const auto& plane : rig.planes)
    if (plane.id == probe.plane) return &plane;
  return bad_input(rig.source + ": probe \"" + probe.id + "\": plane = \"" + probe.plane +
                   "\" is not the id of a [[plane]]; the planes of the rig are: " +
                   (rig.planes.empty() ? "none" : ids_of(rig)));
}

// Returns the plane of a probe; nullptr: the rig has no planes, so the plane is perpendicular to
// the probe.
Result<const TargetPlane*> plane_of(const Rig& rig, const Probe& probe) {
  // Cosines of angles between direction and normal.
  constexpr double kLeastFacingCosine = 0.5, kMargin = 0.15;
  if (!probe.plane.empty()) return named_plane(rig, probe);
  if (rig.planes.empty()) return nullptr;
  const TargetPlane *best = nullptr, *second = nullptr;
  for (const auto& plane : rig.planes) {
    if (!best || cosine(plane, probe) > cosine(*best, probe)) {
      second = best;
      best = &plane;
    } else if (!second || cosine(plane, probe) > cosine(*second, probe)) {
      second = &plane;
    }
  }
  if (cosine(*best, probe) <= kLeastFacingCosine)
    return bad_input(
        rig.source + ": probe \"" + probe.id +
        "\" does not point at any [[plane]] of the rig (the direction of the probe is more than "
        "60° from the normal of every plane); add the [[plane]] that this probe measures");
  if (second && cosine(*second, probe) > cosine(*best, probe) - kMargin)
    return bad_input(rig.source + ": probe \"" + probe.id +
                     "\": its direction fits two planes, \"" + best->id + "\" and \"" + second->id +
                     "\"; add plane = \"...\" with one of these two ids to the [[probe]]");
  return best;
}

std::string in_mm(double m) {
  return plain_number(to_mm(m), 6) + " mm";
}

constexpr double kOnPlane_m = 1e-6;

// The position of a probe is the intersection of its measuring line and the nominal surface, so it
// must be on the plane.
Status check_on_plane(const Rig& rig, const FixtureProbe& probe, const TargetPlane& plane) {
  if (std::abs(probe.plane_offset_m - *plane.offset_m) <= kOnPlane_m) return {};
  return bad_input(
      rig.source + ": probe \"" + probe.id +
      "\": position_mm (the point where the line of the probe meets the plane) is at " +
      in_mm(probe.plane_offset_m) + " along the normal of the plane \"" + plane.id +
      "\", but offset_mm of that plane is " + in_mm(*plane.offset_m) +
      "; correct one of the two values, or give the id of another plane");
}

// Checks that all probes of a plane measure at the same surface. Without [[plane]], probes with
// parallel directions must have the same surface.
Status check_common_planes(const Rig& rig, const Fixture& fixture,
                           const std::vector<const TargetPlane*>& looks_at) {
  constexpr double kSameWay = 1 - 1e-9;
  for (std::size_t i = 0; i < fixture.probes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const FixtureProbe &a = fixture.probes[j], &b = fixture.probes[i];
      const double way = a.n_C.dot(b.n_C);
      if (looks_at[i] != looks_at[j] || std::abs(way) < kSameWay) continue;
      const double of_b = way > 0 ? b.plane_offset_m : -b.plane_offset_m;
      if (std::abs(a.plane_offset_m - of_b) <= kOnPlane_m) continue;
      return bad_input(rig.source + ": probes \"" + a.id + "\" and \"" + b.id +
                       "\" measure one plane, but their values of position_mm give two different "
                       "positions of this plane: " +
                       in_mm(a.plane_offset_m) + " and " + in_mm(of_b) +
                       "; correct position_mm, or declare two [[plane]] tables with offset_mm and "
                       "set plane = \"...\" in each [[probe]]");
    }
  }
  return {};
}

}  // namespace

double height_at(const HeightMap& map, double first_m, double second_m) {
  if (map.empty()) return 0.0;
  const Cell a = cell_of(map.first_m, first_m);
  const Cell b = cell_of(map.second_m, second_m);
  const std::size_t columns = map.second_m.size();
  const auto at = [&](std::size_t i, std::size_t j) {
    return map.height_m[std::min(i, map.first_m.size() - 1) * columns + std::min(j, columns - 1)];
  };
  const double low =
      at(a.index, b.index) * (1 - b.fraction) + at(a.index, b.index + 1) * b.fraction;
  const double high =
      at(a.index + 1, b.index) * (1 - b.fraction) + at(a.index + 1, b.index + 1) * b.fraction;
  return low * (1 - a.fraction) + high * a.fraction;
}

Result<Fixture> make_fixture(const Rig& rig) {
  Fixture fixture;
  fixture.axis = rig.axis;
  std::vector<const TargetPlane*> looks_at;
  for (const auto& probe : rig.probes) {
    FixtureProbe p;
    p.id = probe.id;
    p.p_MP = local_vector(rig.axis, probe.position_m);
    p.u_M = local_vector(rig.axis, probe.direction);
    p.n_C = local_vector(rig.axis, probe.nominal_direction.value_or(probe.direction));
    MDOF_TRY(const TargetPlane* plane, plane_of(rig, probe));
    if (plane) {
      p.n_C = local_vector(rig.axis, plane->normal);
      p.flatness = plane->flatness;
      p.plane = static_cast<std::size_t>(plane - rig.planes.data());
    }
    p.plane_offset_m = p.n_C.dot(p.p_MP);
    if (plane && plane->offset_m) MDOF_CHECK(check_on_plane(rig, p, *plane));
    looks_at.push_back(plane);
    fixture.probes.push_back(std::move(p));
  }
  MDOF_CHECK(check_common_planes(rig, fixture, looks_at));
  return fixture;
}

}  // namespace mdof::algo
