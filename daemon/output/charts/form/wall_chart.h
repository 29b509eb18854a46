// The wall that an end mill leaves, as an SVG document: one turn of it along the feed, at the tip
// and at the top of the cut, and its mean over the depth. Pure.
#pragma once

#include <string>
#include <vector>

#include "algo/milling/wall.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// `lines`: as of algo::wall_lines(), two at least; `turn_m`: feed of a turn. Each mean carries its
// height, the mean, the least and the largest in µm as data-….
std::string wall_svg(const std::vector<algo::WallLine>& lines, double turn_m,
                     const std::string& title, output::Language language);

}  // namespace mdof::charts
