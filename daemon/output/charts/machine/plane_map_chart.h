// The position errors of the tool at points of a plane, drawn as arrows in an SVG document. The
// plane has the same scale along both axes. Pure.
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
  // Number of the table whose corrections are drawn; 0: errors of the machine are drawn.
  std::int64_t table = 0;
  std::string place{};  // position of the other axes, "Z = 5 mm"; empty: not stated
};

// At most kMostArrows points. An arrow shows the two error components in the plane, enlarged. Its
// data-… attributes are the position in mm, and the three error components and their u in µm. If
// picture.table is not 0, the arrows show the corrections of the commands instead of errors.
std::string plane_map_svg(const algo::PlaneMap& map, const MapPicture& picture,
                          output::Language language);

}  // namespace mdof::charts
