// Finds the keys for effects on the probes that a rig does not declare.
#include <algorithm>

#include "schema/rig/effects/physics.h"
#include "schema/rig/rig.h"

namespace mdof {
namespace {

template <class Is>
bool any_probe(const RigPhysics& physics, Is is) {
  return std::any_of(physics.probes.begin(), physics.probes.end(), is);
}

bool has_removed_linearity(const RigPhysics& physics) {
  return std::any_of(physics.left_out.begin(), physics.left_out.end(), [](const auto& c) {
    return !c->linearity.empty() || !c->polynomial_um.empty();
  });
}

// Without the dielectric correction, a condition of the air that is only in the log of a run is not
// known, because it is not stored with the rig.
void add_undeclared_air(const RigPhysics& physics, std::vector<std::string>& keys) {
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    const std::string key = air_quantities()[q].key;
    if (!physics.dielectric && !physics.air->run[q]) keys.push_back("[air] " + key);
    if (!physics.dielectric) continue;
    if (!physics.air->u_run[q].known()) keys.push_back("u_" + key);
    if (!physics.air->u_calibration[q].known()) keys.push_back("u_calibration_" + key);
  }
}

}  // namespace

std::vector<std::string> undeclared_physics(const Rig& rig) {
  std::vector<std::string> keys;
  if (!rig.physics) return keys;
  const RigPhysics& physics = *rig.physics;
  if (physics.asked &&
      any_probe(physics, [](const ProbePhysics& p) { return !p.u_linearity.known(); }))
    keys.emplace_back("u_linearity_um");
  if (any_probe(physics, [&](const ProbePhysics& p) { return !p.tilts(); }))
    keys.emplace_back("sensing_radius_mm and standoff_um");
  if (any_probe(physics,
                [&](const ProbePhysics& p) { return p.tilts() && !p.u_tilt_factor.known(); }))
    keys.emplace_back("u_tilt_factor");
  if (physics.has_known_air_effect())
    add_undeclared_air(physics, keys);
  else
    keys.emplace_back("[air]");
  return keys;
}

bool declares_physics(const Rig& rig) {
  if (!rig.physics) return false;
  const auto adds = [](const ProbePhysics& p) { return p.tilts() || p.u_linearity.declared(); };
  return any_probe(*rig.physics, adds) || has_removed_linearity(*rig.physics) ||
         rig.physics->has_known_air_effect();
}

std::vector<std::string> air_columns(const Rig& rig) {
  std::vector<std::string> columns;
  if (!rig.physics || !rig.physics->dielectric) return columns;
  for (std::size_t q = 0; q < kAirQuantities; ++q)
    if (!rig.physics->air->run[q]) columns.emplace_back(air_quantities()[q].key);
  return columns;
}

}  // namespace mdof
