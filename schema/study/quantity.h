// What may vary in a study, by name: "probe.A.x_um", "installation.yaw_mrad", "travel_mm".
// The list with the meaning of each is in algo/sensitivity/PLAN.md.
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
  probe_tilt,         // a probe's direction by this angle, to a side at random; rad
  probe_tilt_about,   // a probe's direction about one machine axis; rad
  probe_sensitivity,  // the reading's scale error; 1
  probe_noise,        // added to each reading, anew each time; m
  probe_zero,         // added to every reading of a trial; m
  probe_drift,        // added from the zero to the reading, in a series in proportion; m
  part_shift,         // installation of a part of the fixture along one machine axis; m
  part_turn,          // ... about a local axis through the origin of M: roll, pitch, yaw; rad
  plane_turn,         // a target plane about a local axis: its angle to the frame C; rad
  plane_flatness,     // a random smooth height of a target plane, highest to lowest; m
  plane_map,          // the known height map of the rig is wrong by this share; 1
  square,             // true artefact angle minus the one in the rig; rad
  encoder_offset,     // shown minus true travel; m
  encoder_scale,      // ... in proportion to the travel; 1
  encoder_noise,      // ... anew each reading; m
  fixture_heat,       // temperature of the fixture at the reading, against that at the zero; K
  target_heat,        // the same of the target; K
  truth,              // one of the five errors that are to be found; m or rad
  travel,             // where the axis stands; m
};

enum class Part { fixture = 0, top = 1, side = 2 };  // side and top: by the probes' directions

// One random number of one rig.
struct QuantityTarget {
  std::string name;  // without a star: "probe.A.x_um"
  Effect effect = Effect::travel;
  std::size_t probe = 0;      // of the rig, for probe_...
  Part part = Part::fixture;  // for part_... and plane_...
  std::size_t axis = 0;       // 0 1 2: machine axis of a shift or tilt, local axis of a turn;
                              // LocalError of a truth
  double to_si = 1;           // from the unit of the name; a truth's sign is in it
};

// Every name a plan may use with this rig, those with a star among them.
std::vector<std::string> quantity_names(const Rig& rig);

// What a name stands for; a star gives one target a probe. Error: unknown, with the nearest name.
Result<std::vector<QuantityTarget>> resolve_quantity(std::string_view name, const Rig& rig);

}  // namespace mdof
