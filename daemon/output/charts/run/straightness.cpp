// The chart of the straightness of a run: the mean error at each target with the reference lines,
// and the residuals from the least-squares line (ISO 230-1).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "algo/iso230/target_means.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kLinesLegendPx = 64;
constexpr const char* kMeanLine = "ink thin";

// The means of one approach, with their reference lines. `direction` 0: the means of both
// approaches together.
struct ApproachSeries {
  int direction = 0;
  std::vector<Mark> means;      // y in µm, x in mm
  std::vector<double> left_um;  // residuals from the least-squares line
  const ReferenceLines* lines = nullptr;
};

struct StraightnessOfError {
  const ErrorName* name = nullptr;
  std::vector<ApproachSeries> approaches;
  const ApproachSeries* both() const {
    for (const ApproachSeries& s : approaches)
      if (s.direction == 0) return &s;
    return nullptr;
  }
};

const ReferenceLines* lines_through(const StatedResults& results, const std::string& key,
                                    algo::Approach approach) {
  for (const StraightnessLines& of : results.lines)
    if (of.error_key == key && of.approach == to_string(approach)) return &of.lines;
  return nullptr;
}

// The value of a reference line at an encoder position. The line is a function of the travel of the
// moving body in M.
double at_position_m(const ReferenceLine& line, const Sides& sides, double position_m) {
  return line.intercept_m + line.slope_rad * sides.moving_body_travel_m(position_m);
}

StraightnessOfError straightness_of(const StatedResults& results, std::size_t named) {
  const RunHeader& header = results.run.header;
  StraightnessOfError found;
  found.name = &error_names(header.axis)[named];
  const std::array<std::pair<algo::Approach, int>, 3> approaches = {
      {{algo::Approach::forward, 1}, {algo::Approach::reverse, -1}, {algo::Approach::both, 0}}};
  for (const auto& [approach, direction] : approaches) {
    const ReferenceLines* lines = lines_through(results, found.name->key, approach);
    if (!lines) continue;
    ApproachSeries series;
    series.direction = direction;
    series.lines = lines;
    for (const algo::TargetMean& m :
         algo::target_means(header.moving(), results.run.points, approach)) {
      Mark mark;
      mark.x = to_mm(m.position_m);
      mark.y = to_um(m.named[named]);
      mark.direction = direction;
      mark.target = m.target;
      mark.row = series.means.size();
      series.means.push_back(mark);
      series.left_um.push_back(
          to_um(m.named[named] - at_position_m(lines->least_squares, header.sides, m.position_m)));
    }
    found.approaches.push_back(std::move(series));
  }
  return found;
}

std::vector<StraightnessOfError> all_straightness(const StatedResults& results) {
  std::vector<StraightnessOfError> all;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    if (error_names(results.run.header.axis)[k].angle) continue;
    StraightnessOfError found = straightness_of(results, k);
    if (!found.approaches.empty()) all.push_back(std::move(found));
  }
  return all;
}

struct DrawnLine {
  const char* mark;
  const char* name;  // name in the result documents
  Phrase words;
  ReferenceLine ReferenceLines::*line;
};
constexpr std::array<DrawnLine, 3> kLines = {
    {{"ink", "least_squares", Phrase::least_squares, &ReferenceLines::least_squares},
     {"ink dash", "end_point", Phrase::end_points, &ReferenceLines::end_point},
     {"ink dot", "minimum_zone", Phrase::minimum_zone, &ReferenceLines::minimum_zone}}};

Range range_with_lines(const StraightnessOfError& error, const Sides& sides) {
  Range y;
  if (const ApproachSeries* both = error.both())
    for (const DrawnLine& drawn : kLines)
      for (const double x : {both->means.front().x, both->means.back().x})
        y.include(to_um(at_position_m(both->lines->*drawn.line, sides, from_mm(x))));
  for (const ApproachSeries& series : error.approaches)
    for (const Mark& mark : series.means) y.include(mark.y);
  return with_room(y);
}

Range range_left(const StraightnessOfError& error) {
  Range y;
  for (const ApproachSeries& series : error.approaches)
    for (const double left : series.left_um) y.include(left);
  y.include(0);
  return with_room(y);
}

void draw_line_through(Svg& svg, const Panel& panel, const char* mark,
                       const std::vector<Mark>& marks) {
  std::vector<Place> line;
  for (const Mark& each : marks) line.push_back(panel.at(each.x, each.y));
  if (line.size() > 1 && line.size() <= kMostMarks) svg.polyline(mark, line);
}

// Whether the means of a series are drawn as symbols. The mean of both approaches is drawn only if
// the run has no separate approaches.
bool is_drawn(const StraightnessOfError& error, const ApproachSeries& series) {
  return series.direction != 0 || error.approaches.size() == 1;
}

void draw_with_lines(Svg& svg, const Panel& panel, const StraightnessOfError& error,
                     const Sides& sides) {
  if (const ApproachSeries* both = error.both())
    for (const DrawnLine& drawn : kLines) {
      const ReferenceLine& line = both->lines->*drawn.line;
      const double from = both->means.front().x, to = both->means.back().x;
      svg.data("line", drawn.name).data("slope-um-per-m", line.slope_rad * 1e6);
      svg.data("intercept-um", to_um(line.intercept_m));
      svg.line(drawn.mark, panel.at(from, to_um(at_position_m(line, sides, from_mm(from)))),
               panel.at(to, to_um(at_position_m(line, sides, from_mm(to)))));
    }
  std::vector<Mark> marks;
  for (const ApproachSeries& series : error.approaches)
    if (is_drawn(error, series))
      marks.insert(marks.end(), series.means.begin(), series.means.end());
  draw_marks(svg, panel, marks);
}

void draw_left(Svg& svg, const Panel& panel, const StraightnessOfError& error) {
  svg.line("rule", {panel.corner.x, panel.px_y(0)}, {panel.corner.x + panel.width, panel.px_y(0)});
  std::vector<Mark> drawn;
  for (const ApproachSeries& series : error.approaches) {
    std::vector<Mark> marks = series.means;
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i].y = series.left_um[i];
    draw_line_through(svg, panel, series.direction == 0 ? kMeanLine : line_of(series.direction),
                      marks);
    if (is_drawn(error, series)) drawn.insert(drawn.end(), marks.begin(), marks.end());
  }
  draw_marks(svg, panel, drawn);
}

// A line with the three straightness figures of an error; the first figure has its U.
std::string figure_line(const StatedResults& results, const StraightnessOfError& error,
                        Language language) {
  const ApproachSeries* both = error.both();
  if (!both) return "";
  const std::string figure = std::string(error.name->name) + "_straightness_um";
  const Budget* budget = find_budget(results.figures.budgets, figure);
  const double U_um = budget ? to_um(budget->U) : std::nan(""),
               u_um = budget ? to_um(budget->u) : std::nan("");
  const std::string U =
      budget ? phrase(Phrase::U_and_k, language,
                      {uncertainty_text(U_um) + " µm", fixed_text(budget->coverage_factor, 2)})
             : phrase(Phrase::U_is_unknown, language);
  return std::string(error.name->name) + ": " +
         phrase(Phrase::straightness_value, language,
                {value_text(to_um(both->lines->least_squares.zone_m), u_um), U,
                 value_text(to_um(both->lines->end_point.zone_m), u_um),
                 value_text(to_um(both->lines->minimum_zone.zone_m), u_um)});
}

}  // namespace

bool has_straightness(const StatedResults& results) {
  return !all_straightness(results).empty();
}

std::string straightness_svg(const StatedResults& results, Language language) {
  const RunHeader& header = results.run.header;
  const std::vector<StraightnessOfError> errors = all_straightness(results);
  std::vector<Range> y;
  Range x;
  for (const StraightnessOfError& error : errors)
    y.push_back(range_with_lines(error, header.sides));
  for (const StraightnessOfError& error : errors) y.push_back(range_left(error));
  for (const ApproachSeries& series : errors.front().approaches)
    for (const Mark& mark : series.means) x.include(mark.x);
  const std::vector<std::string> marks_of_head =
      with_noise_only_mark(are_noise_only(results.figures.budgets),
                           daemon::warning_marks(results.run, language), language);
  const double top = run_head_height(marks_of_head);
  const Sheet sheet(top + kLinesLegendPx, y, kOutputPx);
  const std::string title = run_title(header, phrase(Phrase::straightness, language), language);
  std::vector<std::string> notes;
  std::string words;
  for (const StraightnessOfError& error : errors) {
    notes.push_back(figure_line(results, error, language));
    words += notes.back() + ". ";
  }
  notes.push_back(results.figures.why.empty()
                      ? phrase(Phrase::u_covers, language,
                               {words::text(covers(results.figures.budgets), language)})
                      : phrase(Phrase::U_missing_because, language, {results.figures.why}));
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, words, Theme::light);
  draw_run_head(svg, title, about_run(header, language), marks_of_head, language);
  std::vector<LegendItem> lines;
  for (const DrawnLine& drawn : kLines)
    lines.push_back({LegendSign::line, drawn.mark, phrase(drawn.words, language)});
  lines.push_back({LegendSign::line, kMeanLine, phrase(Phrase::both_approaches, language)});
  Legend legend;
  for (const ApproachSeries& series : errors.front().approaches) {
    legend.forward |= series.direction > 0;
    legend.reverse |= series.direction < 0;
  }
  draw_marks_legend(svg, top, legend, lines, language);
  for (std::size_t i = 0; i < 2 * errors.size(); ++i) {
    const StraightnessOfError& error = errors[i % errors.size()];
    const Panel panel = sheet.panel(i, with_room(x), false);
    const bool left = i >= errors.size();
    svg.data("panel", error.name->key).data("x-key", "position_mm");
    svg.data("shows", left ? "deviation" : "error");
    svg.begin_group();
    draw_axes(svg, panel, position_key(language));
    draw_y_title(svg, panel,
                 left ? std::string(error.name->name) + " − " +
                            phrase(Phrase::least_squares, language) + "_um"
                      : std::string(error.name->key));
    left ? draw_left(svg, panel, error) : draw_with_lines(svg, panel, error, header.sides);
    svg.end_group();
  }
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace mdof::charts
