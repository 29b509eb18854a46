#include "daemon/output/charts/machine/plane_map_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kMapLongestPx = 560, kMapLeftPx = 60;
constexpr const char* kErrors[] = {"x-um", "y-um", "z-um"};
constexpr const char* kUs[] = {"u-x-um", "u-y-um", "u-z-um"};

double error_um(const algo::PlanePoint& p, std::size_t direction) {
  return to_um(p.error[static_cast<Eigen::Index>(direction)]);
}

double largest_um(const algo::PlaneMap& map) {
  double largest = 0;
  for (const algo::PlanePoint& p : map.points)
    largest = std::max(largest, std::hypot(error_um(p, map.first), error_um(p, map.second)));
  return largest;
}

// The factor by which the arrows are enlarged: the longest arrow is about as long as the distance
// between neighbouring points.
double arrow_enlargement(const algo::PlaneMap& map, double largest) {
  const auto step = [](const std::vector<double>& at) {
    return at.size() > 1 ? at[1] - at[0] : 1e-2;
  };
  const double step_mm = to_mm(std::min(step(map.first_m), step(map.second_m)));
  return largest > 0 && step_mm > 0 ? round_step(0.9 * step_mm * 1e3 / largest) / 2 : 1;
}

Panel true_panel(const algo::PlaneMap& map, double margin_mm, double top) {
  Range x, y;
  for (const auto& [range, at] : {std::pair(&x, &map.first_m), {&y, &map.second_m}}) {
    range->include(to_mm(at->front()) - margin_mm);
    range->include(to_mm(at->back()) + margin_mm);
  }
  return panel_in_proportion({kMarginPx + kMapLeftPx, top}, x, y, kMapLongestPx);
}

void draw_arrow(Svg& svg, const Panel& panel, const algo::PlaneMap& map, std::size_t row,
                double factor) {
  const algo::PlanePoint& p = map.points[row];
  const double x = to_mm(map.first_at(row)), y = to_mm(map.second_at(row));
  const Place from = panel.at(x, y);
  const Place to = panel.at(x + error_um(p, map.first) * factor / 1e3,
                            y + error_um(p, map.second) * factor / 1e3);
  svg.data("row", static_cast<double>(row)).data("first-mm", x).data("second-mm", y);
  for (std::size_t k = 0; k < 3; ++k) {
    svg.data(kErrors[k], error_um(p, k));
    svg.data(kUs[k], to_um(p.u[static_cast<Eigen::Index>(k)]));
  }
  svg.begin_group();
  svg.dot("ink-dot", from, 1.6);
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length > 1) {
    const double head = std::min(5.0, length / 2), ux = (to.x - from.x) / length,
                 uy = (to.y - from.y) / length;
    svg.line("blue", from, to);
    const std::array<Place, 3> tip = {
        {{to.x - head * (ux + 0.5 * uy), to.y - head * (uy - 0.5 * ux)},
         to,
         {to.x - head * (ux - 0.5 * uy), to.y - head * (uy + 0.5 * ux)}}};
    svg.polyline("blue", tip);
  }
  svg.end_group();
}

std::vector<std::string> notes_of_map(const algo::PlaneMap& map, double factor, double largest,
                                      bool corrections, Language language) {
  double u = 0;
  for (const algo::PlanePoint& p : map.points)
    for (const std::size_t k : {map.first, map.second}) {
      const double of = to_um(p.u[static_cast<Eigen::Index>(k)]);
      if (std::isfinite(of)) u = std::max(u, of);
    }
  std::vector<std::string> notes = {
      phrase(corrections ? Phrase::correction_arrows : Phrase::arrows, language,
             {number_text(factor, 6), number_text(largest, 4),
              u > 0 ? number_text(u, 2) + " µm" : phrase(Phrase::unknown, language)})};
  const auto list = [&](Phrase text, const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    if (!all.empty()) notes.push_back(phrase(text, language, {all}));
  };
  list(Phrase::map_not_measured, map.not_measured);
  list(Phrase::map_no_u, map.no_u);
  list(Phrase::map_beyond, map.beyond);
  return notes;
}

}  // namespace

std::string plane_map_svg(const algo::PlaneMap& map, const MapPicture& picture, Language language) {
  const char first = "XYZ"[map.first], second = "XYZ"[map.second];
  const double largest = largest_um(map), factor = arrow_enlargement(map, largest);
  std::vector<std::string> warnings;
  if (picture.simulated) warnings.push_back(phrase(Phrase::simulated_machine, language));
  const auto marks = with_noise_only_mark(picture.noise_only, warnings, language);
  const std::string plane = {first, second};
  const std::string title = picture.machine + ": " +
                            (picture.table == 0 ? phrase(Phrase::tool_error_over, language, {plane})
                                                : phrase(Phrase::corrections_over, language,
                                                         {std::to_string(picture.table), plane}));
  const std::string about = phrase(Phrase::approach, language) + std::string(": ") +
                            picture.approach + (picture.place.empty() ? "" : ", " + picture.place);
  const auto notes = notes_of_map(map, factor, largest, picture.table != 0, language);
  const double top = run_head_height(marks) + 34;
  const Panel panel = true_panel(map, 1.1 * largest * factor / 1e3 + 1e-3, top);
  const double bottom = top + panel.height + 50;
  Svg svg(kWidthPx, bottom + notes_height(notes) + 12, title, about, Theme::light);
  draw_run_head(svg, title, about, marks, language);
  svg.data("panel", std::string{first, second}).data("enlargement", factor);
  svg.data("largest-um", largest);
  svg.begin_group();
  draw_axes(svg, panel, std::string(1, first) + "_mm");
  draw_y_title(svg, panel, std::string(1, second) + "_mm");
  for (std::size_t row = 0; row < map.points.size(); ++row)
    draw_arrow(svg, panel, map, row, factor);
  svg.end_group();
  draw_notes(svg, bottom, notes);
  return svg.take();
}

}  // namespace mdof::charts
