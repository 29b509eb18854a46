// The chart of a parked axis: the drift rate of each reading in each time window.
#include <cmath>

#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/analysis/marked_chart.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kMinuteInS = 60, kHourInS = 3600;

MarkedPanel panel_of_rates(const daemon::ParkedLog& log, const algo::WarmUp& found,
                           std::size_t series) {
  const algo::ParkedSeries& of = log.readings.series[series];
  const bool angle = series >= log.probes && error_names(log.axis)[series - log.probes].angle;
  const double factor = kHourInS * (angle ? 1e6 : 1e9);
  MarkedPanel panel;
  panel.key = of.name;
  panel.title = split_key(of.name).name + (angle ? " / (µrad/h)" : " / (nm/h)");
  for (std::size_t w = 0; w < found.begin_s.size(); ++w) {
    const algo::DriftWindow& window = found.windows[series][w];
    if (!std::isfinite(window.rate_per_s)) continue;
    Mark mark;
    mark.x = (found.begin_s[w] + found.window_s / 2) / kMinuteInS;
    mark.y = window.rate_per_s * factor;
    mark.U = window.u_rate_per_s * factor;
    mark.is_standard = true;
    mark.target = static_cast<int>(w);
    mark.row = w;
    panel.marks.push_back(std::move(mark));
  }
  const double end = log.length_s / kMinuteInS, limit = of.limit_per_s * factor;
  if (std::isfinite(limit))
    panel.lines = {{"orange dash", "limit", {{0, limit}, {end, limit}}},
                   {"orange dash", "- limit", {{0, -limit}, {end, -limit}}}};
  if (found.ready_after_s) panel.vertical_x = *found.ready_after_s / kMinuteInS;
  return panel;
}

}  // namespace

std::string warm_up_svg(const daemon::ParkedLog& log, const algo::WarmUp& found,
                        Language language) {
  MarkedChart chart;
  chart.title = phrase(Phrase::drift_of_parked, language, {std::string(1, letter(log.axis))});
  chart.about = found.ready_after_s ? phrase(Phrase::ready_after, language,
                                             {fixed_text(*found.ready_after_s / kMinuteInS, 1)})
                : found.limited     ? phrase(Phrase::not_ready, language)
                                    : phrase(Phrase::no_drift_limit, language);
  if (log.simulated) chart.warnings = {phrase(Phrase::simulated_machine, language)};
  chart.warnings = with_noise_only_mark(!log.declares, chart.warnings, language);
  chart.x_key = "time_min";
  chart.x_label = std::string(phrase(Phrase::time, language)) + " / min";
  chart.legend = Legend{.band = true, .band_is_u = true};
  for (std::size_t s = 0; s < log.readings.series.size(); ++s)
    chart.panels.push_back(panel_of_rates(log, found, s));
  if (found.limited)
    chart.lines.push_back({LegendSign::line, "orange dash", phrase(Phrase::drift_limit, language)});
  if (found.ready_after_s)
    chart.lines.push_back({LegendSign::line, "ink dot", phrase(Phrase::ready_line, language)});
  chart.notes = {
      phrase(Phrase::drift_rate_note, language, {fixed_text(found.window_s / kMinuteInS, 1)})};
  return marked_chart_svg(chart, language);
}

}  // namespace mdof::charts
