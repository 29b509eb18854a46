// The wall that an end mill has cut, as an SVG document. One panel shows the wall along the feed
// during one turn of the mill, at the tip of the mill and at the top of the cut. Another panel
// shows the mean over one turn against the depth. Pure.
#pragma once

#include <string>
#include <vector>

#include "algo/milling/wall.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// `lines`: the result of algo::wall_lines(), with at least two elements. `turn_m`: feed of one
// turn. The data-… attributes of each mean are its height above the tip, mean, minimum and maximum
// in µm.
std::string wall_svg(const std::vector<algo::WallLine>& lines, double turn_m,
                     const std::string& title, output::Language language);

}  // namespace mdof::charts
