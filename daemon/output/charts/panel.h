// Elements that several plots use: title, legend, panels with axes, and stepped bands.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/charts/axis.h"
#include "daemon/output/charts/svg.h"
#include "schema/study/study.h"

namespace mdof::charts {

inline constexpr double kMarginPx = 24;  // margin around the plot

// Height of the title area, px. draw_head() draws the title and, below it, the subtitle in a less
// prominent colour.
inline constexpr double kHeadPx = 60;
void draw_head(Svg& svg, std::string_view title, std::string_view subtitle);

// "simulation-1: " followed by `what`, or only `what` if the study has no name.
std::string titled(const StudyResult& result, const std::string& what);

// "Monte Carlo, 1 000 000 trials, seed 7". If the study was interrupted, the text states this.
std::string study_line(const StudyResult& result);

enum class LegendSign { line, area, dot };
struct LegendItem {
  LegendSign sign;
  const char* mark;
  std::string text;
};
// Draws the legend in rows from `top` downwards. Returns the lower edge of the last row, px.
double draw_legend(Svg& svg, double top, std::span<const LegendItem> items);

// A rectangular plot area with an x axis and a y axis.
struct Panel {
  Place corner;  // upper left
  double width = 0, height = 0;
  Axis x, y;
  double px_x(double value) const { return corner.x + x.fraction(value) * width; }
  double px_y(double value) const { return corner.y + (1 - y.fraction(value)) * height; }
  Place at(double vx, double vy) const { return {px_x(vx), px_y(vy)}; }
};
// A panel with the same scale along x and y; the longer side is `longest_px` long.
Panel panel_in_proportion(Place corner, const Range& x, const Range& y, double longest_px);
// Draws the grid lines, the tick labels, and the title of the x axis below the panel.
void draw_axes(Svg& svg, const Panel& panel, std::string_view x_key);
// Draws the title of the y axis horizontally above the upper left corner of the panel.
void draw_y_title(Svg& svg, const Panel& panel, std::string_view y_key);

// Height of a panel in a plot with one panel for each output.
inline constexpr double kOutputPx = 170;

// Panels of equal size, two side by side if there are several. All panels have the same left
// margin, which is wide enough for the widest y label.
class Sheet {
 public:
  Sheet(double top_px, std::span<const Range> y_ranges, double panel_height_px);
  Panel panel(std::size_t i, const Range& x, bool logarithmic_x) const;
  double bottom() const;

 private:
  double top_, height_, left_ = 0;
  std::size_t columns_;
  std::vector<Axis> y_;
};

// The interval `from` to `to` of x, with the band `low` to `high` of y. For a line, `low` equals
// `high`. A NaN value makes a gap.
struct Step {
  double from = 0, to = 0, low = 0, high = 0;
};
void draw_band(Svg& svg, const Panel& panel, std::string_view mark, std::span<const Step> steps);
void draw_steps(Svg& svg, const Panel& panel, std::string_view mark, std::span<const Step> steps);

}  // namespace mdof::charts
