#include "daemon/output/charts/machine/circle_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Language;
using output::Phrase;
using output::phrase;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kCircleLegendPx = 44, kOutsidePx = 150, kBasePx = 95;
constexpr int kDivisions = 3;  // largest number of scale circles on each side of the nominal circle

struct PolarScale {
  Place centre;
  double step_um = 1, px_per_um = 1;
  Place at(double angle_rad, double deviation_um) const {
    const double r = kBasePx + deviation_um * px_per_um;
    return {centre.x + r * std::cos(angle_rad), centre.y - r * std::sin(angle_rad)};
  }
};

double largest_deviation_um(const CirclesToDraw& circles) {
  double largest = 0;
  for (const CirclePicture& picture : circles.pictures)
    for (const auto* path : {&picture.path.ccw_m, &picture.path.cw_m})
      for (const double x : *path) largest = std::max(largest, std::abs(to_um(x)));
  return largest;
}

void draw_path(Svg& svg, const PolarScale& scale, const char* mark, const char* name,
               const std::vector<double>& angle_rad, const std::vector<double>& deviation_m) {
  if (deviation_m.empty()) return;
  std::vector<std::size_t> order(angle_rad.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return angle_rad[a] < angle_rad[b]; });
  std::vector<Place> places;
  for (const std::size_t i : order) places.push_back(scale.at(angle_rad[i], to_um(deviation_m[i])));
  if (angle_rad[order.back()] - angle_rad[order.front()] < kTurn) places.push_back(places.front());
  svg.data("line", name);
  svg.polyline(mark, places);
}

void draw_scale(Svg& svg, const PolarScale& scale, const std::string& plane) {
  for (int k = -kDivisions; k <= kDivisions; ++k) {
    std::vector<Place> places;
    for (int i = 0; i <= 180; ++i) places.push_back(scale.at(kTurn * i / 180, k * scale.step_um));
    svg.data("division-um", k * scale.step_um);
    svg.polyline(k == 0 ? "rule" : "grid", places);
  }
  const double out = kOutsidePx, x = scale.centre.x, y = scale.centre.y;
  svg.line("grid", {x - out, y}, {x + out, y});
  svg.line("grid", {x, y - out}, {x, y + out});
  svg.text("quiet", {x + out + 4, y + 4}, Anchor::start, "+" + plane.substr(0, 1));
  svg.text("quiet", {x, y - out - 6}, Anchor::middle, "+" + plane.substr(1, 1));
}

std::string circle_note(const CirclePicture& picture, Language language) {
  const algo::CircularFigures& f = picture.figures;
  std::string text =
      phrase(picture.measured ? Phrase::circle_measured : Phrase::circle_predicted, language);
  for (const auto& [name, value] :
       {std::pair{"G+", f.G_ccw_m}, {"G−", f.G_cw_m}, {"G(b)", f.Gb_m}, {"H", f.H_m}, {"D", f.D_m}})
    text += (text.ends_with("µm") ? ", " : ": ") + std::string(name) + " = " +
            number_text(to_um(value)) + " µm";
  return text;
}

}  // namespace

std::string circles_svg(const CirclesToDraw& circles, Language language) {
  const double largest = largest_deviation_um(circles);
  PolarScale scale;
  scale.step_um = round_step(std::max(largest / kDivisions, 1e-6));
  scale.px_per_um = 50 / (kDivisions * scale.step_um);
  std::vector<std::string> warnings, notes;
  if (circles.simulated) warnings.push_back(phrase(Phrase::simulated_machine, language));
  for (const CirclePicture& picture : circles.pictures)
    notes.push_back(circle_note(picture, language));
  notes.push_back(phrase(Phrase::circle_note, language, {number_text(scale.step_um, 6)}));
  const double top = run_head_height(warnings) + kCircleLegendPx;
  const double bottom = top + 2 * kOutsidePx + 60;
  const std::string about = phrase(Phrase::circle_of_plane, language, {circles.plane});
  Svg svg(kWidthPx, bottom + notes_height(notes) + 12, circles.title, about, Theme::light);
  draw_run_head(svg, circles.title, about, warnings, language);
  const std::array<LegendItem, 2> lines = {
      {{LegendSign::line, "blue", phrase(Phrase::counter_clockwise, language)},
       {LegendSign::line, "orange dash", phrase(Phrase::clockwise, language)}}};
  draw_marks_legend(svg, run_head_height(warnings), {}, lines, language);
  const auto n = static_cast<double>(circles.pictures.size());
  for (std::size_t i = 0; i < circles.pictures.size(); ++i) {
    const CirclePicture& picture = circles.pictures[i];
    scale.centre = {kWidthPx * (static_cast<double>(i) + 0.5) / n, top + kOutsidePx + 34};
    svg.data("panel", picture.measured ? "measured" : "predicted").data("base-px", kBasePx);
    svg.data("px-per-um", scale.px_per_um);
    svg.data("centre-x", scale.centre.x).data("centre-y", scale.centre.y);
    svg.begin_group();
    svg.text(
        "text head", {scale.centre.x - kOutsidePx, top + 12}, Anchor::start,
        phrase(picture.measured ? Phrase::circle_measured : Phrase::circle_predicted, language));
    draw_scale(svg, scale, circles.plane);
    draw_path(svg, scale, "blue", "ccw", picture.path.angle_rad, picture.path.ccw_m);
    draw_path(svg, scale, "orange dash", "cw", picture.path.angle_rad, picture.path.cw_m);
    svg.end_group();
  }
  draw_notes(svg, bottom, notes);
  return svg.take();
}

}  // namespace mdof::charts
