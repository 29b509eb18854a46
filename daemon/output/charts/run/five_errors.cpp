// The chart of the five errors of a run against the position: all points, U, and the mean of each
// approach.
#include <algorithm>
#include <array>
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

constexpr double kLegendPx = 44;

struct ApproachMeans {
  int direction;
  std::vector<algo::TargetMean> means;
};

std::array<ApproachMeans, 2> means_of(const Run& run) {
  const auto of = [&](algo::Approach approach) {
    return algo::target_means(run.header.moving(), run.points, approach);
  };
  return {{{1, of(algo::Approach::forward)}, {-1, of(algo::Approach::reverse)}}};
}

void draw_means(Svg& svg, const Panel& panel, const ApproachMeans& of, std::size_t named) {
  std::vector<Place> places;
  for (const algo::TargetMean& m : of.means)
    places.push_back(panel.at(to_mm(m.position_m), to_key_unit(m.named[named])));
  if (places.size() > 1) svg.polyline(line_of(of.direction), places);
}

// "U = 0.0078–0.0081 µm (k = 2.05, 95 %)". The chart states U as text, because the band of U may be
// narrower than the symbols.
std::string U_line(const StatedResults& results, std::size_t named, Language language) {
  const std::string unit = split_key(error_names(results.run.header.axis)[named].key).unit;
  Range U, k;
  for (std::size_t row = 0; row < results.run.points.size(); ++row) {
    if (!results.run.points[row].errors.valid) continue;
    U.include(to_key_unit(results.uncertainty.points[row].U[named]));
    k.include(results.uncertainty.points[row].coverage_factor[named]);
  }
  if (U.empty || k.empty) return phrase(Phrase::U_is_unknown, language);
  const std::string low = uncertainty_text(U.low), high = uncertainty_text(U.high);
  const std::string k_low = fixed_text(k.low, 2), k_high = fixed_text(k.high, 2);
  return phrase(Phrase::U_and_k, language,
                {(low == high ? low : low + "–" + high) + " " + unit,
                 k_low == k_high ? k_low : k_low + "–" + k_high});
}

std::vector<std::string> notes_of(const StatedResults& results, const std::vector<Mark>& marks,
                                  Language language) {
  std::vector<std::string> notes;
  const RunUncertainty& u = results.uncertainty;
  notes.push_back(u.why.empty()
                      ? phrase(Phrase::u_covers, language, {words::text(covers(u), language)})
                      : phrase(Phrase::U_missing_because, language, {u.why}));
  if (are_drawn_as_columns(marks))
    notes.push_back(phrase(Phrase::envelope, language, {count_text(marks.size())}));
  const auto unsolved = [](const Mark& mark) { return !std::isfinite(mark.y); };
  const auto first = std::find_if(marks.begin(), marks.end(), unsolved);
  if (first != marks.end())
    notes.push_back(phrase(Phrase::unsolved_count, language,
                           {count_text(static_cast<std::uint64_t>(
                                std::count_if(marks.begin(), marks.end(), unsolved))),
                            count_text(marks.size()), first->reason}));
  return notes;
}

}  // namespace

bool has_five_errors(const StatedResults& results) {
  return std::any_of(results.run.points.begin(), results.run.points.end(),
                     [](const MeasuredPoint& p) { return p.errors.valid; });
}

std::string five_errors_svg(const StatedResults& results, Language language) {
  const RunHeader& header = results.run.header;
  std::vector<Range> y;
  Range x;
  std::vector<std::vector<Mark>> marks;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    marks.push_back(error_marks(results, k));
    y.push_back(with_room(range_of_marks(marks.back())));
  }
  for (const Mark& mark : marks.front()) x.include(mark.x);
  const auto means = means_of(results.run);
  const auto notes = notes_of(results, marks.front(), language);
  const std::vector<std::string> marks_of_head = with_noise_only_mark(
      results.uncertainty.noise_only, daemon::warning_marks(results.run, language), language);
  const double top = run_head_height(marks_of_head);
  const Sheet sheet(top + kLegendPx, y, kOutputPx);
  const std::string title = run_title(header, phrase(Phrase::five_errors, language), language);
  std::string words = about_run(header, language) + ".";
  for (const std::string& mark : daemon::warning_marks(results.run, language))
    words += " " + mark + ".";
  const double notes_top = sheet.bottom();
  Svg svg(kWidthPx, notes_top + notes_height(notes) + 12, title, words, Theme::light);
  draw_run_head(svg, title, about_run(header, language), marks_of_head, language);
  const std::array<LegendItem, 1> lines = {
      {{LegendSign::line, "blue thin", phrase(Phrase::mean_of_visits, language)}}};
  draw_marks_legend(svg, top, marks_legend(marks.front()), lines, language);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& name = error_names(header.axis)[k];
    const Panel panel = sheet.panel(k, with_room(x), false);
    svg.data("panel", name.key).data("x-key", "position_mm");
    svg.begin_group();
    draw_axes(svg, panel, position_key(language));
    draw_y_title(svg, panel, name.key);
    svg.text("quiet tick", {panel.corner.x + panel.width, panel.corner.y - 12}, Anchor::end,
             U_line(results, k, language));
    draw_U_bands(svg, panel, marks[k]);
    if (!are_drawn_as_columns(marks[k]))
      for (const ApproachMeans& of : means) draw_means(svg, panel, of, k);
    draw_marks(svg, panel, marks[k]);
    svg.end_group();
  }
  draw_notes(svg, notes_top, notes);
  return svg.take();
}

}  // namespace mdof::charts
