// The mounted probes of a rig, to scale, as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/rig/rig.h"

namespace mdof::charts {

// Views from above (X to the right, Y up) and from the side (X to the right, Z up), in mm of M.
// Each probe has its position and direction in M as data-… attributes. An arrow shows the measuring
// direction; a square shows a direction perpendicular to the picture. Dimension lines connect
// neighbouring probe positions along an axis. The rig must have at least one probe.
std::string fixture_svg(const Rig& rig, output::Language language);

}  // namespace mdof::charts
