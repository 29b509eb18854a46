// The chart of the changes between two runs of an axis, at each target.
#include <array>
#include <cmath>

#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/analysis/marked_chart.h"
#include "daemon/output/charts/run/points.h"
#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr std::array kSidesDrawn = {1, -1};  // the first two of kComparedSides

std::vector<Mark> changes_of(const daemon::ComparedPoints& compared, std::size_t error) {
  std::vector<Mark> marks;
  for (std::size_t row = 0; row < compared.points.size(); ++row)
    for (std::size_t side = 0; side < kSidesDrawn.size(); ++side) {
      const daemon::ComparedPoint& point = compared.points[row];
      const daemon::ComparedValue& value = point.side[side][error];
      Mark mark;
      mark.x = to_mm(point.position_m);
      mark.y = to_key_unit(value.after - value.before);
      mark.U = to_key_unit(std::hypot(value.U_before, value.U_after));
      mark.direction = kSidesDrawn[side];
      mark.target = static_cast<int>(row);
      mark.row = row;
      if (std::isfinite(mark.y)) marks.push_back(mark);
    }
  return marks;
}

}  // namespace

bool has_comparison(const daemon::Comparison& comparison) {
  for (std::size_t k = 0; k < comparison.points.errors.size(); ++k)
    if (!changes_of(comparison.points, k).empty()) return true;
  return false;
}

std::string comparison_svg(const daemon::Comparison& c, Language language) {
  MarkedChart chart;
  chart.title =
      phrase(Phrase::change_of_axis, language,
             {std::string(1, letter(c.axis)), std::to_string(c.before), std::to_string(c.after)});
  chart.about = phrase(Phrase::change_at_targets, language);
  if (c.simulated) chart.warnings = {phrase(Phrase::simulated_machine, language)};
  std::vector<Budget> changes;
  for (const daemon::ComparedFigure& figure : c.figures) changes.push_back(figure.change);
  chart.warnings = with_noise_only_mark(are_noise_only(changes), chart.warnings, language);
  chart.x_key = "position_mm";
  chart.x_label = position_key(language);
  for (std::size_t k = 0; k < c.points.errors.size(); ++k) {
    MarkedPanel panel;
    panel.key = c.points.errors[k];
    panel.marks = changes_of(c.points, k);
    if (panel.marks.empty()) continue;
    panel.lines.push_back(
        {"rule", "zero", {{panel.marks.front().x, 0}, {panel.marks.back().x, 0}}});
    chart.panels.push_back(std::move(panel));
  }
  chart.notes = {phrase(Phrase::change_U_note, language)};
  if (!c.is_imported) chart.notes.push_back(phrase(Phrase::change_about_line, language));
  return marked_chart_svg(chart, language);
}

}  // namespace mdof::charts
