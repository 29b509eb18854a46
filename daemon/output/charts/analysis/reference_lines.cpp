// The chart of deviations from straightness: the deviations with the three reference lines of ISO
// 230-1, and the residuals from the least-squares line.
#include <algorithm>
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

struct LineOfSeries {
  const char* mark;
  const char* name;
  Phrase words;
  ReferenceLine ReferenceLines::*line;
};
constexpr std::array<LineOfSeries, 3> kLinesOfSeries = {
    {{"blue", "least_squares", Phrase::least_squares, &ReferenceLines::least_squares},
     {"orange dash", "end_point", Phrase::end_points, &ReferenceLines::end_point},
     {"ink dot", "minimum_zone", Phrase::minimum_zone, &ReferenceLines::minimum_zone}}};

double line_at(const ReferenceLine& line, double position_m) {
  return line.intercept_m + line.slope_rad * position_m;
}

std::vector<Mark> marks_about(const StraightnessPicture& picture, const ReferenceLine& line) {
  std::vector<Mark> marks;
  for (std::size_t row = 0; row < picture.position_m.size(); ++row) {
    Mark mark;
    mark.x = to_mm(picture.position_m[row]);
    mark.y = to_um(picture.deviation_m[row] - line_at(line, picture.position_m[row]));
    mark.row = row;
    marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace

std::string reference_lines_svg(const StraightnessPicture& picture, Language language) {
  MarkedChart chart;
  chart.title = phrase(Phrase::straightness, language);
  chart.about = picture.about;
  chart.warnings = picture.warnings;
  chart.x_key = "position_mm";
  chart.x_label = position_key(language);
  chart.legend = Legend{};
  MarkedPanel measured, left;
  measured.key = "deviation_um";
  measured.title = std::string(phrase(Phrase::deviation, language)) + "_um";
  measured.marks = marks_about(picture, {});
  left.key = "residual_um";
  left.title = std::string(phrase(Phrase::deviation, language)) + " − " +
               phrase(Phrase::least_squares, language) + "_um";
  left.marks = marks_about(picture, picture.lines.least_squares);
  const double first = picture.lines.first_m, last = picture.lines.last_m;
  left.lines = {{"rule", "zero", {{to_mm(first), 0}, {to_mm(last), 0}}}};
  for (const LineOfSeries& of : kLinesOfSeries) {
    const ReferenceLine& line = picture.lines.*of.line;
    measured.lines.push_back(
        {of.mark,
         of.name,
         {{to_mm(first), to_um(line_at(line, first))}, {to_mm(last), to_um(line_at(line, last))}}});
    chart.lines.push_back({LegendSign::line, of.mark, phrase(of.words, language)});
    chart.notes.push_back(phrase(Phrase::zone_about, language,
                                 {phrase(of.words, language), number_text(to_um(line.zone_m))}));
  }
  chart.panels = {std::move(measured), std::move(left)};
  return marked_chart_svg(chart, language);
}

}  // namespace mdof::charts
