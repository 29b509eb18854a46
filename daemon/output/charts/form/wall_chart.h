// The wall that an end mill leaves, as an SVG document: one turn along the feed, at the tip and at
// the top of the cut, and the mean over the depth. Pure.
#pragma once

#include <string>
#include <vector>

#include "algo/milling/wall.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// `lines`: as from algo::wall_lines(), at least two; `turn_m`: feed of one turn. Each mean has its
// height, mean, minimum and maximum in µm as data-… attributes.
std::string wall_svg(const std::vector<algo::WallLine>& lines, double turn_m,
                     const std::string& title, output::Language language);

}  // namespace mdof::charts
