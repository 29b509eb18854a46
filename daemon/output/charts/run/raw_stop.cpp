#include "daemon/output/charts/run/raw_stop.h"

#include <array>
#include <cmath>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kRawLegendPx = 44;

std::string key_of(const Channel& channel) {
  const std::string unit = suffix(channel.unit);
  return channel.id + (unit.empty() ? "" : "_" + unit);
}

std::vector<Mark> marks_of_series(const RawSeries& series, std::int64_t begin_ns) {
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    Mark mark;
    mark.x = ns_to_s(series.time_ns[i] - begin_ns);
    mark.y = series.value[i];
    mark.direction = 1;  // draw_mark() draws a disc for this value
    mark.row = i;
    const Quality quality = series.quality[i];
    if (!std::isfinite(mark.y))
      mark.reason = to_string(quality);
    else if (quality > Quality::simulated)
      mark.flags = to_string(quality);
    marks.push_back(std::move(mark));
  }
  return marks;
}

void draw_averaged(Svg& svg, const Panel& panel, double length_s) {
  for (const auto& [name, at] : {std::pair("begin", 0.0), {"end", length_s}}) {
    const double x = panel.px_x(at);
    svg.data("line", name).data("x", at);
    svg.line("orange dash", {x, panel.corner.y}, {x, panel.corner.y + panel.height});
  }
}

}  // namespace

std::string raw_stop_svg(const StatedResults& results, std::size_t row,
                         const std::vector<RawSeries>& channels, Language language) {
  const MeasuredPoint& p = results.run.points[row];
  const double length_s = ns_to_s(p.point.end_ns - p.point.begin_ns);
  std::vector<std::vector<Mark>> marks;
  std::vector<Range> y;
  Range x;
  x.include(0);
  x.include(length_s);
  for (const RawSeries& series : channels) {
    marks.push_back(marks_of_series(series, p.point.begin_ns));
    y.push_back(with_room(range_of_marks(marks.back())));
    for (const Mark& mark : marks.back()) x.include(mark.x);
  }
  const std::string side = p.point.direction > 0 ? "+" : p.point.direction < 0 ? "−" : "?";
  const std::string title = run_title(
      results.run.header,
      phrase(Phrase::raw_stop, language,
             {std::to_string(row), std::to_string(p.target), std::to_string(p.run), side}),
      language);
  const std::string about = about_run(results.run.header, language);
  const std::vector<std::string> notes = {phrase(Phrase::raw_note, language)};
  const auto head =
      with_noise_only_mark(false, daemon::warning_marks(results.run, language), language);
  const double top = run_head_height(head);
  const Sheet sheet(top + kRawLegendPx, y, kOutputPx);
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, head, language);
  const std::array<LegendItem, 2> legend = {
      {{LegendSign::dot, "blue-dot", phrase(Phrase::reading, language)},
       {LegendSign::line, "orange dash", phrase(Phrase::averaged_part, language)}}};
  draw_legend(svg, top, legend);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Panel panel = sheet.panel(i, with_room(x), false);
    svg.data("panel", key_of(channels[i].channel)).data("x-key", "time_s");
    svg.begin_group();
    draw_axes(svg, panel, std::string(phrase(Phrase::time, language)) + "_s");
    draw_y_title(svg, panel, key_of(channels[i].channel));
    draw_averaged(svg, panel, length_s);
    draw_marks(svg, panel, marks[i]);
    svg.end_group();
  }
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace mdof::charts
