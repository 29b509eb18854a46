// Draws circular tests (ISO 230-4) as an SVG document with polar diagrams that have the same scale.
// Pure.
#pragma once

#include <string>
#include <vector>

#include "algo/machine/geometric_tests/circle.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

struct CirclePicture {
  bool measured = false;  // false: the path was predicted
  algo::CircularPath path;
  algo::CircularFigures figures;
};

struct CirclesToDraw {
  std::string title, plane;  // "XY"
  bool simulated = false;
  std::vector<CirclePicture> pictures;  // one or two
};

// Each diagram states its scale in two attributes. data-base-px: radius of the circle with
// deviation 0, px. data-px-per-um: px for a deviation of 1 µm.
std::string circles_svg(const CirclesToDraw& circles, output::Language language);

}  // namespace mdof::charts
