// The circular test (ISO 230-4) as polar diagrams with a common scale, as an SVG document. Pure.
#pragma once

#include <string>
#include <vector>

#include "algo/machine/geometric_tests/circle.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

struct CirclePicture {
  bool measured = false;  // otherwise predicted
  algo::CircularPath path;
  algo::CircularFigures figures;
};

struct CirclesToDraw {
  std::string title, plane;  // "XY"
  bool simulated = false;
  std::vector<CirclePicture> pictures;  // one or two
};

// Each group has its scale as data-base-px (radius of zero deviation) and data-px-per-um.
std::string circles_svg(const CirclesToDraw& circles, output::Language language);

}  // namespace mdof::charts
