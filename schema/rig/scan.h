// A probe F that scans a part on a spindle. At the same time the axis of the rig moves along the
// radius of the part, and the probes of the fixture measure the straightness of this movement:
//
//   [scan]
//   probe = "F"                # column F_um (or F_mm) of the log; F is not a [[probe]] of the rig
//   position_mm = [0, 5, 30]   # point in M at which the line of measurement meets the part
//   measures = "+Z"            # positive heights: out of the part; perpendicular to the axis
//   centre_mm = 12.5           # encoder position at which F measures on the spindle's axis
//   angle = "angle_deg"        # column with the rotation of the part about `measures`
//   sense = "+"                # the rotation is right-handed; "-": left-handed
//   delay_us = 0               # delay of the readings of F relative to the angle and the encoder
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

struct RigScan {
  std::string probe, angle;  // ids of their channels in the log
  Vec3 position_m{}, direction{};
  double centre_m = 0;
  double sense = 1;
  double delay_s = 0;  // of the readings of the probe relative to the angle and the encoder
};

// Called by parse_rig(). Errors are recorded in the table.
std::optional<RigScan> read_scan(TomlTable& rig, Axis axis);

// Reads [scan] from the text of a rig that parse_rig() has accepted; nullopt: no [scan].
Result<std::optional<RigScan>> scan_of_rig(std::string_view rig_text, Axis axis,
                                           const std::string& source);

}  // namespace mdof
