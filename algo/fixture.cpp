#include "algo/fixture.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

Eigen::Vector3d local_vector(Axis axis, const Vec3& v) {
  const Vec3 l = to_local(axis, v);
  return {l[0], l[1], l[2]};
}

const TargetPlane* nearest_plane(const Rig& rig, const Probe& probe) {
  const TargetPlane* best = nullptr;
  double best_cosine = 0;
  for (const auto& plane : rig.planes) {
    const double cosine =
        std::abs(plane.normal[0] * probe.direction[0] + plane.normal[1] * probe.direction[1] +
                 plane.normal[2] * probe.direction[2]);
    if (cosine > best_cosine) {
      best = &plane;
      best_cosine = cosine;
    }
  }
  return best_cosine > 0.5 ? best : nullptr;
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
  for (const auto& probe : rig.probes) {
    FixtureProbe p;
    p.id = probe.id;
    p.p_MP = local_vector(rig.axis, probe.position_m);
    p.u_M = local_vector(rig.axis, probe.direction);
    p.n_C = p.u_M;
    p.plane_offset_m = p.n_C.dot(p.p_MP);
    if (const TargetPlane* plane = nearest_plane(rig, probe)) {
      p.n_C = local_vector(rig.axis, plane->normal);
      p.plane_offset_m = plane->offset_m.value_or(p.n_C.dot(p.p_MP));
      p.flatness = plane->flatness;
    } else if (!rig.planes.empty()) {
      return bad_input(rig.source + ": probe \"" + probe.id +
                       "\" looks at none of the [[plane]] tables (its direction is more than 60° "
                       "from every normal); add the plane it measures");
    }
    fixture.probes.push_back(std::move(p));
  }
  return fixture;
}

}  // namespace mdof::algo
