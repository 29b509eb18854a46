// Draws the mounted probes of a rig to scale as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/rig/rig.h"

namespace mdof::charts {

// Views from above (X to the right, Y up) and from the side (X to the right, Z up), in mm in frame
// M. The data-… attributes of each probe are its position and direction in M. An arrow shows the
// measuring direction. A square shows a measuring direction perpendicular to the picture. A
// dimension line shows the distance between neighbouring probes along an axis. The rig must have at
// least one probe.
std::string fixture_svg(const Rig& rig, output::Language language);

}  // namespace mdof::charts
