// Errors of the tool over a plane as arrows, true to scale, as an SVG document. Pure.
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
  std::string machine, approach;  // name of the machine; "mean", "forward", "reverse"
  bool simulated = false;
  NoiseOnly noise_only = NoiseOnly::none;
  std::int64_t table = 0;  // corrections of this table; 0: errors of the machine
  std::string place{};     // position of the other axes, "Z = 5 mm"; empty: not stated
};

// At most kMostArrows points. An arrow shows the two errors in the plane, enlarged, and has its
// position in mm, the three errors and their u in µm as data-… attributes. For a table, the arrows
// show the corrections of the commands.
std::string plane_map_svg(const algo::PlaneMap& map, const MapPicture& picture,
                          output::Language language);

}  // namespace mdof::charts
