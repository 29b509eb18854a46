// Names of the quantities that may vary in a study, for example "probe.A.x_um",
// "installation.yaw_mrad", "travel_mm". algo/sensitivity/PLAN.md lists all names and their
// meanings. In the list below, the unit follows the semicolon; 1: no unit.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof {

enum class Effect {
  probe_shift,        // position of a probe along one machine axis; m
  probe_circle,       // position of a probe, on a circle perpendicular to its direction; m
  probe_tilt,         // angle by which the direction of a probe tilts to a random side; rad
  probe_tilt_about,   // tilt of the direction of a probe about one machine axis; rad
  probe_sensitivity,  // relative error of the scale of the readings; 1
  probe_noise,        // added to each reading, with a new random value each time; m
  probe_zero,         // added to every reading of a trial, with the same value; m
  probe_drift,        // drift since the zero; in a series it increases from 0 to this value; m
  part_shift,         // installation of a part of the fixture: shift along one machine axis; m
  // Installation: turn about a local axis through the origin of M (roll, pitch, yaw); rad.
  part_turn,
  plane_turn,      // turn of a target plane relative to the frame C, about a local axis; rad
  plane_flatness,  // random smooth height of a target plane, peak to valley; m
  plane_map,       // relative error of the height map in the rig; 1
  square,          // true angle of the artefact minus the angle in the rig; rad
  encoder_offset,  // indicated travel minus true travel; m
  encoder_scale,   // indicated travel minus true travel, relative to the travel; 1
  encoder_noise,  // indicated travel minus true travel, with a new random value for each reading; m
  fixture_heat,   // temperature of the fixture at the reading minus its temperature at the zero; K
  target_heat,    // temperature of the target at the reading minus its temperature at the zero; K
  truth,          // one of the five errors that are to be determined; m or rad
  travel,         // position of the axis; m
};

// top: the probes that measure along the local z, and their plane; side: the same for the local y.
enum class Part { fixture = 0, top = 1, side = 2 };

// One random number that applies to one rig.
struct QuantityTarget {
  std::string name;  // without a star: "probe.A.x_um"
  Effect effect = Effect::travel;
  std::size_t probe = 0;      // index in the rig, for probe_...
  Part part = Part::fixture;  // for part_... and plane_... only
  // Index of an axis or an error. Shift, tilt: machine axis; turn: local axis; truth: LocalError.
  std::size_t axis = 0;
  double to_si = 1;  // factor from the unit of the name to SI; for a truth it includes the sign
};

// All names that a plan may use with this rig. Names with a star are included.
std::vector<std::string> quantity_names(const Rig& rig);

// Returns the targets of a name; a name with a star has one target for each probe. Error: the name
// is unknown; the message contains the most similar name.
Result<std::vector<QuantityTarget>> resolve_quantity(std::string_view name, const Rig& rig);

}  // namespace mdof
