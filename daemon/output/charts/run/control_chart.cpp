#include "daemon/output/charts/run/control_chart.h"

#include <algorithm>
#include <array>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/axis.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kControlLegendPx = 44, kControlPx = 300;

std::string runs_text(const daemon::TrendValue& value) {
  std::string text;
  for (const std::int64_t run : value.runs) text += (text.empty() ? "" : " ") + std::to_string(run);
  return text;
}

bool is_outside(const algo::Chart& chart, std::size_t i) {
  return std::find(chart.outside.begin(), chart.outside.end(), i) != chart.outside.end() ||
         std::find(chart.one_side.begin(), chart.one_side.end(), i) != chart.one_side.end();
}

void draw_limit(Svg& svg, const Panel& panel, const char* name, const char* mark,
                const std::vector<double>& of) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < of.size(); ++i)
    places.push_back(panel.at(static_cast<double>(i + 1), to_key_unit(of[i])));
  svg.data("line", name);
  svg.polyline(mark, places);
}

void draw_value(Svg& svg, const Panel& panel, const daemon::Trend& trend, std::size_t i) {
  const daemon::TrendValue& v = trend.values[i];
  const double x = static_cast<double>(i + 1), y = to_key_unit(v.stated.value);
  svg.data("row", static_cast<double>(i)).data("x", x).data("y", y);
  svg.data("u", to_key_unit(v.stated.u));
  if (trend.chart)
    svg.data("low", to_key_unit(trend.chart->low[i]))
        .data("high", to_key_unit(trend.chart->high[i]));
  svg.data("runs", runs_text(v));
  svg.begin_group(runs_text(v) + ", " + v.started_utc);
  const Place at = panel.at(x, y);
  svg.dot("blue-dot", at, 3);
  if (trend.chart && is_outside(*trend.chart, i)) {
    constexpr double r = 5;
    svg.line("cross", {at.x - r, at.y - r}, {at.x + r, at.y + r});
    svg.line("cross", {at.x - r, at.y + r}, {at.x + r, at.y - r});
  }
  svg.end_group();
}

std::vector<std::string> notes_of_trend(const daemon::Trend& trend, Language language) {
  std::vector<std::string> notes;
  if (!trend.chart) notes.push_back(phrase(Phrase::no_limits, language));
  notes.push_back(
      phrase(Phrase::small_u_covers, language, {words::text(trend.u_covers, language)}));
  notes.push_back(phrase(Phrase::control_rules, language));
  return notes;
}

}  // namespace

std::string control_chart_svg(const daemon::Trend& trend, Language language) {
  Range x, y;
  x.include(1);
  x.include(static_cast<double>(trend.values.size()));
  for (const daemon::TrendValue& v : trend.values) y.include(to_key_unit(v.stated.value));
  if (trend.chart)
    for (const auto* limits : {&trend.chart->low, &trend.chart->high})
      for (const double limit : *limits) y.include(to_key_unit(limit));
  std::vector<std::string> warnings;
  for (const Notice& notice : trend.notices) warnings.push_back(words::text(notice, language));
  const auto marks = with_noise_only_mark(trend.noise_only, warnings, language);
  const auto notes = notes_of_trend(trend, language);
  const std::string title =
      split_key(trend.figure).name + ": " + phrase(Phrase::over_the_runs, language);
  const std::string about = trend.values.front().started_utc.substr(0, 10) + " – " +
                            trend.values.back().started_utc.substr(0, 10);
  const double top = run_head_height(marks);
  const std::array<Range, 1> ranges = {with_room(y)};
  const Sheet sheet(top + kControlLegendPx, ranges, kControlPx);
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, marks, language);
  const std::array<LegendItem, 3> legend = {
      {{LegendSign::dot, "blue-dot", phrase(Phrase::value, language)},
       {LegendSign::line, "ink", phrase(Phrase::centre_line, language)},
       {LegendSign::line, "orange dash", phrase(Phrase::control_limits, language)}}};
  draw_legend(svg, top, legend);
  const Panel panel = sheet.panel(0, with_room(x), false);
  svg.data("panel", trend.figure).data("x-key", "run_in_time");
  svg.begin_group();
  draw_axes(svg, panel, phrase(Phrase::run_in_time, language));
  draw_y_title(svg, panel, trend.figure);
  if (trend.chart) {
    draw_limit(svg, panel, "centre", "ink",
               std::vector<double>(trend.values.size(), trend.chart->centre));
    draw_limit(svg, panel, "low", "orange dash", trend.chart->low);
    draw_limit(svg, panel, "high", "orange dash", trend.chart->high);
  }
  for (std::size_t i = 0; i < trend.values.size(); ++i) draw_value(svg, panel, trend, i);
  svg.end_group();
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace mdof::charts
