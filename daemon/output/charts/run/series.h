// Draws the points of a run in a panel: a symbol for each point, bands of U, and lines of means.
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

// A symbol in a chart: one value y at one position x, in the units of the result documents.
struct Mark {
  double x = 0, y = 0;
  double U = std::nan("");
  bool is_standard = false;  // true: the member `U` contains the standard uncertainty u
  int direction = 0;
  int target = 0;
  std::size_t row = 0;  // index of the point in the result, from 0; attribute data-row
  std::string flags;    // flags of the point, separated by spaces; empty: no flag
  std::string reason;   // why the errors of the point are unknown; y is then NaN
};

// Largest number of symbols of one approach; see draw_marks().
inline constexpr std::size_t kMostMarks = 2000;

// Range from the smallest y - U to the largest y + U of all marks.
Range range_of_marks(std::span<const Mark> marks);
// Extends a range at both ends, so that whole symbols are inside the panel.
Range with_room(const Range& range);

// Draws one symbol.
// - forward: a disc
// - reverse: a hollow square
// - unknown approach: a hollow diamond
// - a point with flags: its symbol with a cross
// - a point without a value (y is NaN): a cross at the upper edge of the panel
void draw_mark(Svg& svg, const Panel& panel, const Mark& mark);
// Draws a symbol for each mark. If an approach has more than kMostMarks marks, the function instead
// divides the panel into columns that are 1 px wide, and draws a line from the minimum to the
// maximum of each column. Outliers stay visible.
void draw_marks(Svg& svg, const Panel& panel, std::span<const Mark> marks);
bool are_drawn_as_columns(std::span<const Mark> marks);

// Draws a band of U for each approach. At each target (or column, if the marks are drawn as
// columns) the band extends from the smallest y - U to the largest y + U. Draws no band if U is
// unknown.
void draw_U_bands(Svg& svg, const Panel& panel, std::span<const Mark> marks);

const char* line_of(int direction);  // CSS classes of a line: solid for forward, dashed for reverse

// Draws the title ("run 3, axis X"), the subtitle below it, and then the warnings `marks`
// ("SIMULATED: …") in the alarm colour. Draws at most three warnings and states the number of the
// other warnings. Returns the lower edge of this area, px.
double draw_run_head(Svg& svg, const std::string& title, const std::string& subtitle,
                     const std::vector<std::string>& marks, Language language);
double run_head_height(const std::vector<std::string>& marks);

// Draws sentences below the panels, wrapped to the width of the chart. Returns the lower edge of
// the last line, px.
double draw_notes(Svg& svg, double top, const std::vector<std::string>& notes);
double notes_height(const std::vector<std::string>& notes);

// The entries in the legend of the symbols.
struct Legend {
  bool forward = false, reverse = false, unknown = false, flagged = false, unsolved = false;
  bool band = false, band_is_u = false;
};
// Draws at most two rows. Returns the lower edge of the last row, px.
double draw_marks_legend(Svg& svg, double top, const Legend& legend,
                         std::span<const LegendItem> lines, Language language);

}  // namespace mdof::charts
