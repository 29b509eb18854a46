#include "schema/rig/check/rig_notes.h"

#include "schema/rig/calibrated.h"
#include "schema/rig/effects/physics.h"
#include "schema/rig/rig.h"

namespace mdof {
namespace {

std::string corrections_of(const RigPhysics& physics) {
  std::string what = physics.tilt ? "tilt" : "";
  if (physics.dielectric) what += what.empty() ? "dielectric" : " and dielectric";
  return "readings are corrected for " + what + ", as [corrections] of the rig requests";
}

}  // namespace

// A rig is read only where it can have something to say: lists have thousands of runs.
std::vector<std::string> rig_notes(std::string_view rig_text) {
  const auto has = [&](std::string_view word) { return rig_text.find(word) != rig_text.npos; };
  if (!has("calibration") && !has("corrections")) return {};
  const auto rig = parse_rig(rig_text, "rig");
  if (!rig) return {};
  std::vector<std::string> notes = calibration_notes(*rig);
  if (rig->physics && rig->physics->corrects()) notes.push_back(corrections_of(*rig->physics));
  return notes;
}

}  // namespace mdof
