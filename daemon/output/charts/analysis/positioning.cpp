// The chart of a test to ISO 230-2: every reading, the mean of each approach, and ± 2 s of each
// approach.
#include <array>

#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/analysis/marked_chart.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

std::vector<Mark> marks_of_readings(const std::vector<PositioningReading>& readings) {
  std::vector<Mark> marks;
  for (std::size_t row = 0; row < readings.size(); ++row) {
    Mark mark;
    mark.x = to_mm(readings[row].target_m);
    mark.y = to_key_unit(readings[row].deviation);
    mark.direction = readings[row].direction;
    mark.row = row;
    marks.push_back(std::move(mark));
  }
  return marks;
}

std::vector<NamedLine> lines_of_figures(const Positioning& figures) {
  std::vector<NamedLine> lines = {{"blue", "forward mean", {}},
                                  {"blue dot thin", "forward mean + 2s", {}},
                                  {"blue dot thin", "forward mean - 2s", {}},
                                  {"orange dash", "reverse mean", {}},
                                  {"orange dot thin", "reverse mean + 2s", {}},
                                  {"orange dot thin", "reverse mean - 2s", {}},
                                  {"ink thin", "mean", {}}};
  for (const PositioningTarget& t : figures.targets) {
    const std::array values = {
        t.forward.mean, t.forward.mean + 2 * t.forward.s, t.forward.mean - 2 * t.forward.s,
        t.reverse.mean, t.reverse.mean + 2 * t.reverse.s, t.reverse.mean - 2 * t.reverse.s,
        t.mean};
    for (std::size_t i = 0; i < values.size(); ++i)
      lines[i].values.push_back({to_mm(t.target_m), to_key_unit(values[i])});
  }
  return lines;
}

std::string figures_text(const PositioningSeries& series) {
  const auto& [key, f, readings] = series;
  std::string text = split_key(key).name + ":";
  for (const auto& [name, value] : {std::pair{"A", f.A},
                                    {"A+", f.A_forward},
                                    {"A−", f.A_reverse},
                                    {"E", f.E},
                                    {"E+", f.E_forward},
                                    {"E−", f.E_reverse},
                                    {"M", f.M},
                                    {"R", f.R},
                                    {"R+", f.R_forward},
                                    {"R−", f.R_reverse},
                                    {"B", f.B},
                                    {"mean B", f.B_mean}})
    if (std::isfinite(value))
      text += std::string(text.ends_with(':') ? " " : ", ") + name + " = " +
              number_text(to_key_unit(value));
  return text + " " + split_key(key).unit;
}

}  // namespace

std::string positioning_svg(const PositioningPicture& picture, Language language) {
  MarkedChart chart;
  chart.title = picture.title;
  chart.about = picture.about;
  chart.warnings = picture.warnings;
  chart.x_key = "position_mm";
  chart.x_label = position_key(language);
  for (const PositioningSeries& series : picture.series) {
    MarkedPanel panel;
    panel.key = series.key;
    panel.marks = marks_of_readings(series.readings);
    panel.lines = lines_of_figures(series.figures);
    chart.panels.push_back(std::move(panel));
    chart.notes.push_back(figures_text(series));
  }
  chart.lines = {{LegendSign::line, "blue", phrase(Phrase::mean_forward, language)},
                 {LegendSign::line, "orange dash", phrase(Phrase::mean_reverse, language)},
                 {LegendSign::line, "ink thin", phrase(Phrase::both_approaches, language)},
                 {LegendSign::line, "blue dot thin", phrase(Phrase::two_s, language)}};
  chart.notes.push_back(phrase(Phrase::two_s_note, language));
  return marked_chart_svg(chart, language);
}

}  // namespace mdof::charts
