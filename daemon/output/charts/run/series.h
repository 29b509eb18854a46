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
  bool is_standard = false;  // it is u instead
  int direction = 0;
  int target = 0;
  std::size_t row = 0;  // of the result's points, from 0; drawn as data-row
  std::string flags;    // space between them; empty: nothing is wrong
  std::string reason;   // of a point without errors: y is NaN
};

inline constexpr std::size_t kMostMarks = 2000;  // of an approach; more are drawn as columns

// y of all of them with their U.
Range range_of_marks(std::span<const Mark> marks);
// A range whose markers stay inside the panel.
Range with_room(const Range& range);

// A disc forward, a hollow square in reverse, a hollow diamond where the approach is not known; a
// cross over a flagged one, and at the upper edge for one without a value.
void draw_mark(Svg& svg, const Panel& panel, const Mark& mark);
// Each, or where an approach has more than kMostMarks the least and the greatest of every column of
// a pixel, so that no outlier is lost.
void draw_marks(Svg& svg, const Panel& panel, std::span<const Mark> marks);
bool are_drawn_as_columns(std::span<const Mark> marks);

// Of each approach, from the least y - U to the greatest y + U of each target (of each column,
// where the marks are drawn as columns); nothing where no U is known.
void draw_U_bands(Svg& svg, const Panel& panel, std::span<const Mark> marks);

const char* line_of(int direction);  // class of a line: solid forward, dashed in reverse

// "run 3, axis X", with the note below and, where it is simulated or doubtful, the first of the
// marks in the alarm colour. Gives where the head ends.
double draw_run_head(Svg& svg, const std::string& title, const std::string& subtitle,
                     const std::vector<std::string>& marks, Language language);
double run_head_height(const std::vector<std::string>& marks);

// Sentences below the panels, in lines of the chart's width; gives where they end.
double draw_notes(Svg& svg, double top, const std::vector<std::string>& notes);
double notes_height(const std::vector<std::string>& notes);

// A legend of marks: forward, reverse and what else is in it.
struct Legend {
  bool forward = false, reverse = false, unknown = false, flagged = false, unsolved = false;
  bool band = false, band_is_u = false;
};
// Two rows at most; gives where they end.
double draw_marks_legend(Svg& svg, double top, const Legend& legend,
                         std::span<const LegendItem> lines, Language language);

}  // namespace mdof::charts
