#include "algo/form/pose/places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "schema/base/random.h"

namespace mdof::algo {

Turn::Turn(double rad)
    : cos(rad == 0 ? 1 : sine_of_turns(rad / (2 * std::numbers::pi) + 0.25)),
      sin(sine_of_turns(rad / (2 * std::numbers::pi))) {}

Places places_of(const SurfaceMap& a, std::size_t most) {
  Places places;
  const std::size_t measured = a.measured(), every = std::max<std::size_t>(1, measured / most);
  std::size_t least_i = a.nx, most_i = 0, least_j = a.ny, most_j = 0, k = 0;
  // Selects pixels by a hash of their number. A constant step that has a common factor with the row
  // length would omit whole columns.
  std::uint64_t mixed = 0;
  for (std::size_t j = 0; j < a.ny; ++j)
    for (std::size_t i = 0; i < a.nx; ++i) {
      const double z = a.at(i, j);
      if (std::isnan(z)) continue;
      least_i = std::min(least_i, i);
      most_i = std::max(most_i, i);
      least_j = std::min(least_j, j);
      most_j = std::max(most_j, j);
      mixed = k++ * 0x9e3779b97f4a7c15u;
      if (every > 1 && (mixed >> 33) % every != 0) continue;
      places.x_m.push_back(a.x_m(i));
      places.y_m.push_back(a.y_m(j));
      places.z_m.push_back(z);
    }
  if (measured == 0) return places;
  places.x_mid_m = (a.x_m(least_i) + a.x_m(most_i)) / 2;
  places.y_mid_m = (a.y_m(least_j) + a.y_m(most_j)) / 2;
  places.size_m = std::max(static_cast<double>(most_i - least_i + 1) * a.dx_m,
                           static_cast<double>(most_j - least_j + 1) * a.dy_m);
  for (double& x : places.x_m) x -= places.x_mid_m;
  for (double& y : places.y_m) y -= places.y_mid_m;
  return places;
}

MapPose about_origin(const MapPose& about_middle, const Places& a) {
  const Turn turn(about_middle.turn_rad);
  MapPose pose = about_middle;
  pose.shift_x_m += (1 - turn.cos) * a.x_mid_m + turn.sin * a.y_mid_m;
  pose.shift_y_m += (1 - turn.cos) * a.y_mid_m - turn.sin * a.x_mid_m;
  pose.turn_rad = std::remainder(pose.turn_rad, 2 * std::numbers::pi);
  if (pose.turn_rad <= -std::numbers::pi) pose.turn_rad = std::numbers::pi;
  return pose;
}

}  // namespace mdof::algo
