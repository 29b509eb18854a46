// Errors of the tool over a plane as arrows, in true proportions, as an SVG document. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "algo/machine/plane_map.h"
#include "daemon/output/phrases.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof::charts {

inline constexpr std::size_t kMostArrows = 2500;

struct MapPicture {
  std::string machine, approach;  // its name; "mean", "forward", "reverse"
  bool simulated = false;
  NoiseOnly noise_only = NoiseOnly::none;
  std::int64_t table = 0;  // corrections of this table; 0: errors of the machine
  std::string place{};     // of the other axes, "Z = 5 mm"; empty: not stated
};

// At most kMostArrows points. Each arrow goes from its place to where the tool is by both errors of
// the plane, enlarged; it carries its place in mm, the three errors and their u in µm as data-….
// Of a table: to where its corrections bring the commands, likewise.
std::string plane_map_svg(const algo::PlaneMap& map, const MapPicture& picture,
                          output::Language language);

}  // namespace mdof::charts
