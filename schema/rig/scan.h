// A probe that looks at a part on a spindle while the axis of the rig goes along the part's radius,
// beside the probes of the fixture, which see how straight it goes:
//
//   [scan]
//   probe = "F"                # column F_um (or F_mm) of the log; no [[probe]] of the fixture
//   position_mm = [0, 5, 30]   # in M, where its line meets the part
//   measures = "+Z"            # heights count along it, out of the part; across the axis
//   centre_mm = 12.5           # of the encoder, where it looks at the spindle's axis
//   angle = "angle_deg"        # column: how far the part has turned about `measures`
//   sense = "+"                # right-handed; "-": left-handed
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

struct RigScan {
  std::string probe, angle;  // ids of their columns
  Vec3 position_m{}, direction{};
  double centre_m = 0;
  double sense = 1;
};

// For parse_rig(): what is wrong is recorded in the table.
std::optional<RigScan> read_scan(TomlTable& rig, Axis axis);

// Of the text of a rig that parse_rig() has accepted; none: it has no [scan].
Result<std::optional<RigScan>> scan_of_rig(std::string_view rig_text, Axis axis,
                                           const std::string& source);

}  // namespace mdof
