// A chart of several quantities over one: a panel each, with marks, bands of U and lines. Pure.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// Through these places, in the units of the panel; what is not finite is left out.
struct NamedLine {
  const char* mark;  // class of style.h
  std::string name;  // drawn as data-line
  std::vector<Place> values;
};

struct MarkedPanel {
  std::string key;    // drawn as data-panel
  std::string title;  // of y; empty: the key
  std::string note;   // above the upper right corner
  std::vector<Mark> marks;
  std::vector<NamedLine> lines;      // y of each is within the panel
  double vertical_x = std::nan("");  // where a line goes from edge to edge, data-line "vertical"
};

struct MarkedChart {
  std::string title, about;
  std::vector<std::string> warnings;  // in the alarm colour
  std::string x_key, x_label;         // of the data; of the axis, with its unit
  std::vector<MarkedPanel> panels;    // one at least
  std::optional<Legend> legend;       // none: as the marks are
  std::vector<LegendItem> lines;      // of the legend
  std::vector<std::string> notes;
};

std::string marked_chart_svg(const MarkedChart& chart, output::Language language);

}  // namespace mdof::charts
