// A chart with one panel for each quantity; all panels have the same x axis. A panel shows plotted
// points (Mark), bands of U and lines. Pure.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// A line through these points, in the units of the panel. Points with a non-finite coordinate are
// left out.
struct NamedLine {
  const char* mark;  // CSS class from style.h
  std::string name;  // attribute data-line
  std::vector<Place> values;
};

struct MarkedPanel {
  std::string key;    // attribute data-panel
  std::string title;  // title of the y axis; empty: `key` is the title
  std::string note;   // text above the upper right corner of the panel
  std::vector<Mark> marks;
  std::vector<NamedLine> lines;      // each y must be inside the panel
  double vertical_x = std::nan("");  // x of a vertical line over the whole height of the panel
};

struct MarkedChart {
  std::string title, about;
  std::vector<std::string> warnings;  // drawn in the alarm colour
  std::string x_key, x_label;  // name of the data-… attribute; label of the axis with its unit
  std::vector<MarkedPanel> panels;  // at least one
  std::optional<Legend> legend;     // nullopt: made from the plotted points
  std::vector<LegendItem> lines;    // legend entries for `MarkedPanel::lines`
  std::vector<std::string> notes;
};

std::string marked_chart_svg(const MarkedChart& chart, output::Language language);

}  // namespace mdof::charts
