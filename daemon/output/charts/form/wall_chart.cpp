#include "daemon/output/charts/form/wall_chart.h"

#include <algorithm>
#include <array>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kWallLegendPx = 44, kWallPx = 260;

std::string in_um(Phrase name, Language language) {
  return std::string(phrase(name, language)) + "_um";
}

// Draws the wall along one turn. The first point is repeated at the end of the turn.
void draw_turn(Svg& svg, const Panel& panel, const char* name, const char* mark,
               const algo::WallLine& line, double turn_m) {
  const std::size_t n = line.outward_m.size();
  std::vector<Place> places;
  for (std::size_t i = 0; i <= n; ++i)
    places.push_back(panel.at(to_um(turn_m * static_cast<double>(i) / static_cast<double>(n)),
                              to_um(line.outward_m[i % n])));
  svg.data("line", name);
  svg.polyline(mark, places);
}

// Draws the mean at one height, and a line from the minimum to the maximum at this height.
void draw_mean(Svg& svg, const Panel& panel, const algo::WallLine& line, std::size_t row) {
  const auto [least, most] = std::minmax_element(line.outward_m.begin(), line.outward_m.end());
  const double x = to_um(line.height_m), y = to_um(line.mean_m()), low = to_um(*least),
               high = to_um(*most);
  svg.data("row", static_cast<double>(row)).data("x", x).data("y", y);
  svg.data("low", low).data("high", high);
  svg.begin_group();
  svg.line("rule", panel.at(x, low), panel.at(x, high));
  svg.dot("blue-dot", panel.at(x, y), 3);
  svg.end_group();
}

}  // namespace

std::string wall_svg(const std::vector<algo::WallLine>& lines, double turn_m,
                     const std::string& title, Language language) {
  Range along, height, outward;
  along.include(0);
  along.include(to_um(turn_m));
  for (const algo::WallLine& line : lines) {
    height.include(to_um(line.height_m));
    for (const double y : line.outward_m) outward.include(to_um(y));
  }
  const std::vector<std::string> notes = {phrase(Phrase::wall_note, language)};
  const std::string about = phrase(Phrase::simulated_machine, language);
  const double top = run_head_height({});
  const std::array<Range, 2> ranges = {with_room(outward), with_room(outward)};
  const Sheet sheet(top + kWallLegendPx, ranges, kWallPx);
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, {}, language);
  const std::array<LegendItem, 4> legend = {
      {{LegendSign::line, "blue", phrase(Phrase::wall_at_tip, language)},
       {LegendSign::line, "orange dash", phrase(Phrase::wall_at_top, language)},
       {LegendSign::dot, "blue-dot", phrase(Phrase::wall_mean, language)},
       {LegendSign::line, "rule", phrase(Phrase::wall_range, language)}}};
  draw_legend(svg, top, legend);
  const auto begin = [&](std::size_t i, const char* name, const Range& x, Phrase x_title) {
    Panel panel = sheet.panel(i, x, false);
    svg.data("panel", name).begin_group();
    draw_axes(svg, panel, in_um(x_title, language));
    draw_y_title(svg, panel, in_um(Phrase::wall_outward, language));
    return panel;
  };
  const Panel turn = begin(0, "turn", along, Phrase::along_the_feed);
  draw_turn(svg, turn, "top", "orange dash", lines.back(), turn_m);
  draw_turn(svg, turn, "tip", "blue", lines.front(), turn_m);
  svg.end_group();
  const Panel depth = begin(1, "depth", with_room(height), Phrase::height_above_tip);
  for (std::size_t i = 0; i < lines.size(); ++i) draw_mean(svg, depth, lines[i], i);
  svg.end_group();
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace mdof::charts
