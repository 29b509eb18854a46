// Quantities that may vary in a study, by name: "probe.A.x_um", "installation.yaw_mrad",
// "travel_mm". algo/sensitivity/PLAN.md lists them with their meaning.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof {

enum class Effect {
  probe_shift,        // one coordinate of a probe's position, machine axes; m
  probe_circle,       // a probe's position on a circle across its direction; m
  probe_tilt,         // a probe's direction by this angle, to a random side; rad
  probe_tilt_about,   // a probe's direction about one machine axis; rad
  probe_sensitivity,  // relative error of the reading's scale; 1
  probe_noise,        // added to each reading, a new value each time; m
  probe_zero,         // added to every reading of a trial; m
  probe_drift,        // added from the zero to the reading, in a series proportionally; m
  part_shift,         // installation of a part of the fixture along one machine axis; m
  part_turn,          // ... about a local axis through the origin of M: roll, pitch, yaw; rad
  plane_turn,         // a target plane about a local axis: its angle to the frame C; rad
  plane_flatness,     // random smooth height of a target plane, highest to lowest; m
  plane_map,          // relative error of the rig's height map; 1
  square,             // true artefact angle minus the one in the rig; rad
  encoder_offset,     // indicated minus true travel; m
  encoder_scale,      // indicated minus true travel, proportional to the travel; 1
  encoder_noise,      // indicated minus true travel, a new value for each reading; m
  fixture_heat,       // temperature of the fixture at the reading, minus that at the zero; K
  target_heat,        // the same for the target; K
  truth,              // one of the five errors to be determined; m or rad
  travel,             // position of the axis; m
};

enum class Part { fixture = 0, top = 1, side = 2 };  // side and top: by the probes' directions

// One random number of one rig.
struct QuantityTarget {
  std::string name;  // without a star: "probe.A.x_um"
  Effect effect = Effect::travel;
  std::size_t probe = 0;      // index in the rig, for probe_...
  Part part = Part::fixture;  // for part_... and plane_...
  std::size_t axis = 0;       // 0 1 2: machine axis of a shift or tilt, local axis of a turn;
                              // LocalError of a truth
  double to_si = 1;           // from the unit of the name; includes the sign of a truth
};

// All names that a plan may use with this rig, including those with a star.
std::vector<std::string> quantity_names(const Rig& rig);

// Targets of a name; a star gives one target for each probe. Error: unknown, with the nearest name.
Result<std::vector<QuantityTarget>> resolve_quantity(std::string_view name, const Rig& rig);

}  // namespace mdof
