#include "daemon/output/charts/analysis/marked_chart.h"

#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr double kOneRowPx = 44, kMoreRowsPx = 64, kOnlyPanelPx = 320;

Range range_of_panel(const MarkedPanel& panel) {
  Range range = range_of_marks(panel.marks);
  for (const NamedLine& line : panel.lines)
    for (const Place& at : line.values)
      if (std::isfinite(at.y)) range.include(at.y);
  return with_room(range);
}

Range range_of_x(const MarkedChart& chart) {
  Range range;
  for (const MarkedPanel& panel : chart.panels)
    for (const Mark& mark : panel.marks) range.include(mark.x);
  return with_room(range);
}

Legend legend_of_all(const MarkedChart& chart) {
  if (chart.legend) return *chart.legend;
  std::vector<Mark> all;
  for (const MarkedPanel& panel : chart.panels)
    all.insert(all.end(), panel.marks.begin(), panel.marks.end());
  return marks_legend(all);
}

void draw_named_line(Svg& svg, const Panel& panel, const NamedLine& line) {
  std::vector<Place> places;
  for (const Place& at : line.values)
    if (std::isfinite(at.x) && std::isfinite(at.y)) places.push_back(panel.at(at.x, at.y));
  if (places.size() < 2) return;
  svg.data("line", line.name);
  svg.polyline(line.mark, places);
}

void draw_panel(Svg& svg, const Panel& panel, const MarkedChart& chart, const MarkedPanel& of) {
  svg.data("panel", of.key).data("x-key", chart.x_key);
  svg.begin_group();
  draw_axes(svg, panel, chart.x_label);
  draw_y_title(svg, panel, of.title.empty() ? of.key : of.title);
  svg.text("quiet tick", {panel.corner.x + panel.width, panel.corner.y - 12}, Anchor::end, of.note);
  draw_U_bands(svg, panel, of.marks);
  for (const NamedLine& line : of.lines) draw_named_line(svg, panel, line);
  if (std::isfinite(of.vertical_x)) {
    const double x = panel.px_x(of.vertical_x);
    svg.data("line", "vertical");
    svg.line("ink dot", {x, panel.corner.y}, {x, panel.corner.y + panel.height});
  }
  draw_marks(svg, panel, of.marks);
  svg.end_group();
}

}  // namespace

std::string marked_chart_svg(const MarkedChart& chart, output::Language language) {
  std::vector<Range> y;
  for (const MarkedPanel& panel : chart.panels) y.push_back(range_of_panel(panel));
  const Range x = range_of_x(chart);
  const double top = run_head_height(chart.warnings);
  const Sheet sheet(top + (chart.lines.size() > 1 ? kMoreRowsPx : kOneRowPx), y,
                    y.size() == 1 ? kOnlyPanelPx : kOutputPx);
  Svg svg(kWidthPx, sheet.bottom() + notes_height(chart.notes) + 12, chart.title, chart.about,
          Theme::light);
  draw_run_head(svg, chart.title, chart.about, chart.warnings, language);
  draw_marks_legend(svg, top, legend_of_all(chart), chart.lines, language);
  for (std::size_t i = 0; i < chart.panels.size(); ++i)
    draw_panel(svg, sheet.panel(i, x, false), chart, chart.panels[i]);
  draw_notes(svg, sheet.bottom(), chart.notes);
  return svg.take();
}

}  // namespace mdof::charts
