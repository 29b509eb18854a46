// The probes of a rig as they are mounted, to scale, as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/rig/rig.h"

namespace mdof::charts {

// From above (X to the right, Y up) and from the side (X to the right, Z up), in mm of M. Each
// probe has its place and its direction in M as data-…; an arrow shows the measuring direction, a
// square a direction that is square to the picture. Dimension lines go from each place of probes
// along an axis to the next. At least one probe.
std::string fixture_svg(const Rig& rig, output::Language language);

}  // namespace mdof::charts
