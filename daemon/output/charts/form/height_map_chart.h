// A height map as coloured cells, true to scale, as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/form/height_map.h"

namespace mdof::charts {

// The longer side has at most kMostCells cells. The colour of a cell shows the height in it that is
// farthest from the middle of all heights, so that spikes stay visible. The cell has its smallest
// and largest height in µm and its position in mm as data-… attributes. A cell without a height is
// left out.
inline constexpr std::size_t kMostCells = 80;

// The map must have at least one height.
std::string height_map_svg(const SurfaceMap& map, const std::string& title,
                           output::Language language);

}  // namespace mdof::charts
