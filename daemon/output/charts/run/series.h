// Points of a run in a panel: markers by approach, bands of U, lines of means.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/svg.h"

namespace mdof::charts {

// One value at one position, in the units of the result documents.
struct Mark {
  double x = 0, y = 0;
  double U = std::nan("");
  bool is_standard = false;  // U contains u instead
  int direction = 0;
  int target = 0;
  std::size_t row = 0;  // index of the result's point, from 0; attribute data-row
  std::string flags;    // separated by spaces; empty: no fault
  std::string reason;   // reason of a point without errors, whose y is NaN
};

inline constexpr std::size_t kMostMarks = 2000;  // limit for each approach; more marks are drawn as
                                                 // columns

// Range of y - U to y + U of all marks.
Range range_of_marks(std::span<const Mark> marks);
// Extends a range so that its markers stay inside the panel.
Range with_room(const Range& range);

// A disc for forward, a hollow square for reverse, a hollow diamond for an unknown approach. A
// flagged mark has a cross; a mark without a value is a cross at the upper edge.
void draw_mark(Svg& svg, const Panel& panel, const Mark& mark);
// Draws all marks. If an approach has more than kMostMarks, it draws the minimum and maximum of
// each pixel column instead, so that outliers stay visible.
void draw_marks(Svg& svg, const Panel& panel, std::span<const Mark> marks);
bool are_drawn_as_columns(std::span<const Mark> marks);

// A band for each approach, from the smallest y - U to the largest y + U of each target (or of each
// column, if the marks are drawn as columns). Draws nothing if U is unknown.
void draw_U_bands(Svg& svg, const Panel& panel, std::span<const Mark> marks);

const char* line_of(int direction);  // class of a line: solid forward, dashed in reverse

// "run 3, axis X", with the note below it. For simulated or doubtful runs the first marks follow in
// the alarm colour. Returns the bottom of the head.
double draw_run_head(Svg& svg, const std::string& title, const std::string& subtitle,
                     const std::vector<std::string>& marks, Language language);
double run_head_height(const std::vector<std::string>& marks);

// Sentences below the panels, in lines of the chart's width; returns the bottom.
double draw_notes(Svg& svg, double top, const std::vector<std::string>& notes);
double notes_height(const std::vector<std::string>& notes);

// Content of the legend of marks: forward, reverse and so on.
struct Legend {
  bool forward = false, reverse = false, unknown = false, flagged = false, unsolved = false;
  bool band = false, band_is_u = false;
};
// At most two rows; returns the bottom.
double draw_marks_legend(Svg& svg, double top, const Legend& legend,
                         std::span<const LegendItem> lines, Language language);

}  // namespace mdof::charts
