// The chart of a compensation table: the errors against the position, with separate forward and
// reverse values.
#include <cmath>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/axis.h"
#include "schema/imported/series.h"
#include "schema/rig/correction.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kTableLegendPx = 44;

struct TableSeries {
  std::string key;  // "EYX_um"
  std::vector<Mark> marks;
  std::string correction;  // how the error is corrected, or why it is not corrected
};

// Adds symbols with the standard uncertainty u, because a table contains no coverage factor k.
void add_marks(std::vector<Mark>& marks, const CompensationTable& table, int direction,
               const std::vector<double>& values, const std::vector<double>& u) {
  for (std::size_t i = 0; i < table.position_m.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    Mark mark;
    mark.x = to_mm(table.position_m[i]);
    mark.y = to_key_unit(values[i]);
    mark.U = to_key_unit(u[i]);
    mark.is_standard = true;
    mark.direction = direction;
    mark.target = static_cast<int>(i);
    mark.row = i;
    marks.push_back(mark);
  }
}

std::string correction_line(int factor, const std::string& command, const std::string& gap,
                            Language language) {
  if (factor == 0) return phrase(Phrase::no_correction, language, {gap});
  return phrase(Phrase::correction, language, {factor > 0 ? "+" : "−", command});
}

std::vector<TableSeries> series_of_table(const CompensationTable& table, Language language) {
  std::vector<TableSeries> all;
  const CorrectionSigns signs =
      correction_signs(table.machine, table.axis, table.sides, table.stated.reference);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& name = error_names(table.axis)[k];
    TableSeries series;
    series.key = name.key;
    for (const bool forward : {true, false}) {
      std::vector<double> u;
      for (std::size_t i = 0; i < table.position_m.size(); ++i)
        u.push_back(table.u_of(forward ? table.u_forward : table.u_reverse, k, i));
      add_marks(series.marks, table, forward ? 1 : -1,
                forward ? table.forward[k] : table.reverse[k], u);
    }
    series.correction = correction_line(signs.factor[k], std::string(1, corrected_by(name)),
                                        signs.gap[k], language);
    if (!series.marks.empty()) all.push_back(std::move(series));
  }
  if (!table.has_positioning()) return all;
  const PositioningErrors& p = table.positioning;
  TableSeries series;
  series.key = positioning_name(table.axis) + "_um";
  for (const bool forward : {true, false}) {
    std::vector<double> u;
    for (std::size_t i = 0; i < table.position_m.size(); ++i)
      u.push_back(table.positioning_u_at(forward, i));
    add_marks(series.marks, table, forward ? 1 : -1, forward ? p.forward : p.reverse, u);
  }
  series.correction = correction_line(-1, std::string(1, letter(table.axis)), "", language);
  if (!series.marks.empty()) all.push_back(std::move(series));
  return all;
}

}  // namespace

bool has_table(const CompensationTable& table) {
  return !series_of_table(table, Language::english).empty();
}

std::string table_svg(const CompensationTable& table, const std::vector<std::string>& warning_marks,
                      Language language) {
  const std::vector<TableSeries> all = series_of_table(table, language);
  const std::vector<std::string> marks =
      with_noise_only_mark(table.noise_only(), warning_marks, language);
  std::vector<Range> y;
  Range x;
  for (const TableSeries& series : all) {
    y.push_back(with_room(range_of_marks(series.marks)));
    for (const Mark& mark : series.marks) x.include(mark.x);
  }
  const std::string title = phrase(Phrase::table_of_axis, language,
                                   {std::to_string(table.id), std::string(1, letter(table.axis))});
  const std::string about = phrase(Phrase::table_sense, language, {table.sides.moves()}) +
                            ", SHA-256 " + table.sha256.substr(0, 16) + "…";
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < all.size();) {  // one note for equal texts
    std::string names;
    const std::string& words = all[i].correction;
    for (; i < all.size() && all[i].correction == words; ++i)
      names += (names.empty() ? "" : ", ") + split_key(all[i].key).name;
    notes.push_back(names + ": " + words);
  }
  notes.push_back(phrase(Phrase::small_u_covers, language, {words::text(covers(table), language)}));
  const double top = run_head_height(marks);
  const Sheet sheet(top + kTableLegendPx, y, kOutputPx);
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, marks, language);
  Legend legend = marks_legend(all.front().marks);
  legend.band_is_u = true;
  draw_marks_legend(svg, top, legend, {}, language);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Panel panel = sheet.panel(i, with_room(x), false);
    svg.data("panel", all[i].key).data("x-key", "position_mm");
    svg.begin_group();
    draw_axes(svg, panel, position_key(language));
    draw_y_title(svg, panel, all[i].key);
    draw_U_bands(svg, panel, all[i].marks);
    draw_marks(svg, panel, all[i].marks);
    svg.end_group();
  }
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace mdof::charts
