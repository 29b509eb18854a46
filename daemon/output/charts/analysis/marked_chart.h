// A chart with one panel for each quantity over a common x, with marks, bands of U and lines. Pure.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// A line through these points, in the units of the panel; non-finite points are left out.
struct NamedLine {
  const char* mark;  // class of style.h
  std::string name;  // attribute data-line
  std::vector<Place> values;
};

struct MarkedPanel {
  std::string key;    // attribute data-panel
  std::string title;  // title of y; empty: the key
  std::string note;   // above the upper right corner
  std::vector<Mark> marks;
  std::vector<NamedLine> lines;      // y must be inside the panel
  double vertical_x = std::nan("");  // x of a line from edge to edge, data-line "vertical"
};

struct MarkedChart {
  std::string title, about;
  std::vector<std::string> warnings;  // texts in the alarm colour
  std::string x_key, x_label;         // key of the data; label of the axis, with its unit
  std::vector<MarkedPanel> panels;    // at least one
  std::optional<Legend> legend;       // nullopt: derived from the marks
  std::vector<LegendItem> lines;      // lines of the legend
  std::vector<std::string> notes;
};

std::string marked_chart_svg(const MarkedChart& chart, output::Language language);

}  // namespace mdof::charts
