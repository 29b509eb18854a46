// Draws a height map as an SVG document with coloured cells and the same scale along x and y. Pure.
#pragma once

#include <string>

#include "daemon/output/phrases.h"
#include "schema/form/height_map.h"

namespace mdof::charts {

// Largest number of cells along the longer side of the map. A cell contains several pixels. The
// colour of a cell shows the height of the pixel that differs most from the middle between the
// lowest and the highest height of the map; this keeps spikes visible. The data-… attributes of a
// cell are its smallest and largest height in µm and its position in mm. A cell without a height is
// not drawn.
inline constexpr std::size_t kMostCells = 80;

// The map must have at least one height.
std::string height_map_svg(const SurfaceMap& map, const std::string& title,
                           output::Language language);

}  // namespace mdof::charts
