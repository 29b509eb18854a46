#include "algo/probe_physics/gap.h"

#include <Eigen/Geometry>
#include <cmath>

namespace mdof::algo {

Eigen::Vector3d tilt_of(const FixtureProbe& probe, const Eigen::Matrix3d& R_MC) {
  const Eigen::Vector3d n_M = R_MC * probe.n_C;
  return n_M.cross(probe.u_M);
}

namespace {

// Returns k (r θ)²/4, m².
double tilt_area(const ProbePhysics& physics, double tilt_square) {
  const double r = physics.sensing_radius_m;
  return physics.tilt_factor * r * r * tilt_square / 4;
}

}  // namespace

double gap_decrease_by_tilt_m(const ProbePhysics& physics, double tilt_square, double gap_m) {
  return tilt_area(physics, tilt_square) / gap_m;
}

// With a = tilt_area() and g = d_shown ε/ε_cal: d - a/d = g  =>  d = (g + sqrt(g² + 4 a))/2. This
// is the solution for which d = g if a = 0.
double true_gap_m(const ProbePhysics& physics, double shown_m, double tilt_square,
                  double permittivity_ratio) {
  const double g = shown_m * permittivity_ratio;
  return (g + std::sqrt(g * g + 4 * tilt_area(physics, tilt_square))) / 2;
}

bool touches(const ProbePhysics& physics, double tilt_square, double gap_m) {
  return !(gap_m > 0 && physics.sensing_radius_m * std::sqrt(tilt_square) < gap_m);
}

}  // namespace mdof::algo
