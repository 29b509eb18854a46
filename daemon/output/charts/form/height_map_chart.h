// A height map as coloured cells, in true proportions, as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/form/height_map.h"

namespace mdof::charts {

// The longer side has at most kMostCells cells. A cell has the colour of the height in it that is
// farthest from the middle of all heights, so that no spike is lost; it carries the smallest and
// the largest in µm, and its place in mm, as data-…. A cell without a height is left out.
inline constexpr std::size_t kMostCells = 80;

// A map that has a height.
std::string height_map_svg(const SurfaceMap& map, const std::string& title,
                           output::Language language);

}  // namespace mdof::charts
