#include "daemon/output/charts/machine/fixture_chart.h"

#include <algorithm>
#include <cmath>

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

constexpr double kViewPx = 280, kArrowPx = 34, kViewTopPx = 104;
// kDimensionPx: distance of the dimension lines from the panel. kTickLengthPx: half of the length
// of a tick on a dimension line.
constexpr double kDimensionPx = 12, kTickLengthPx = 4;

double longest_span_mm(const Rig& rig) {
  double longest = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Range range;
    for (const Probe& probe : rig.probes) range.include(to_mm(probe.position_m[axis]));
    longest = std::max(longest, range.span());
  }
  return longest;
}

// The range of one view along `axis`. All views have the same scale, and space for the arrows.
Range range_in_view(const Rig& rig, std::size_t axis, double span_mm) {
  Range range;
  for (const Probe& probe : rig.probes) range.include(to_mm(probe.position_m[axis]));
  const double middle = (range.low + range.high) / 2, half = 0.75 * span_mm;
  range.include(middle - half);
  range.include(middle + half);
  return range;
}

constexpr double kNameShiftPx =
    14;  // shift between the names of probes at the same place of a view

Place place_of(const Panel& panel, const Probe& probe, std::size_t up) {
  return panel.at(to_mm(probe.position_m[0]), to_mm(probe.position_m[up]));
}

void draw_probe(Svg& svg, const Panel& panel, const Rig& rig, std::size_t k, std::size_t up) {
  const Probe& probe = rig.probes[k];
  const Place from = place_of(panel, probe, up);
  const auto here = [&](const Probe& other) {
    const Place at = place_of(panel, other, up);
    return std::hypot(at.x - from.x, at.y - from.y) < kNameShiftPx / 2;
  };
  const auto before =
      std::count_if(rig.probes.begin(), rig.probes.begin() + static_cast<std::ptrdiff_t>(k), here);
  const double x = probe.direction[0], y = -probe.direction[up], length = std::hypot(x, y);
  svg.data("probe", probe.id);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    svg.data(name + "-mm", to_mm(probe.position_m[axis]));
    svg.data("direction-" + name, probe.direction[axis]);
  }
  svg.begin_group();
  svg.dot("blue-dot", from, 3.5);
  if (length > 0.1) {
    const Place to = {from.x + kArrowPx * x, from.y + kArrowPx * y};
    const double ux = x / length * 7, uy = y / length * 7;
    svg.line("blue", from, to);
    svg.line("blue", to, {to.x - ux - uy / 2, to.y - uy + ux / 2});
    svg.line("blue", to, {to.x - ux + uy / 2, to.y - uy - ux / 2});
  } else {
    svg.rect("blue hollow", {from.x - 7, from.y - 7}, 14, 14);
    svg.dot("blue-dot", from, 3.5);
  }
  svg.text("text head", {from.x + 9 + kNameShiftPx * static_cast<double>(before), from.y - 9},
           Anchor::start, probe.id);
  svg.end_group();
}

// The positions of the probes along `axis`; each position once.
std::vector<double> places_mm(const Rig& rig, std::size_t axis) {
  constexpr double kSamePlace_mm = 1e-6;
  std::vector<double> places;
  for (const Probe& probe : rig.probes) places.push_back(to_mm(probe.position_m[axis]));
  std::sort(places.begin(), places.end());
  const auto same = [](double a, double b) { return b - a < kSamePlace_mm; };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

// Draws dimension lines between neighbouring probe positions: above the panel for horizontal
// distances, to the right of the panel for vertical distances. If a number does not fit, it is
// omitted; the table of probes contains it.
void draw_dimensions(Svg& svg, const Panel& panel, const Rig& rig, std::size_t axis) {
  const bool level = axis == 0;
  const double line =
      level ? panel.corner.y - kDimensionPx : panel.corner.x + panel.width + kDimensionPx;
  const auto at = [&](double mm, double off_px) {
    return level ? Place{panel.px_x(mm), line + off_px} : Place{line + off_px, panel.px_y(mm)};
  };
  const std::vector<double> places = places_mm(rig, axis);
  if (places.size() < 2) return;
  for (const double place : places)
    svg.line("rule", at(place, -kTickLengthPx), at(place, kTickLengthPx));
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double mm = places[i + 1] - places[i];
    const Place from = at(places[i], 0), to = at(places[i + 1], 0);
    const std::string text = number_text(mm);
    const double room_px = std::hypot(to.x - from.x, to.y - from.y);
    svg.data("dimension", std::string(1, "xyz"[axis])).data("mm", mm);
    svg.line("rule", from, to);
    if (room_px < (level ? text_width(text, kTickPx) : kTickPx)) continue;
    const Place middle = {(from.x + to.x) / 2, (from.y + to.y) / 2};
    if (level)
      svg.text("text tick", {middle.x, middle.y - 4}, Anchor::middle, text);
    else
      svg.text("text tick", {middle.x + 6, middle.y + 4}, Anchor::start, text);
  }
}

}  // namespace

std::string fixture_svg(const Rig& rig, Language language) {
  const double span = longest_span_mm(rig), top = kViewTopPx;
  const std::string title = phrase(Phrase::fixture_drawing, language);
  const std::string about = phrase(Phrase::fixture_views, language);
  const std::vector<std::string> notes = {phrase(Phrase::fixture_note, language)};
  Svg svg(kWidthPx, top + kViewPx + 50 + notes_height(notes) + 12, title, about, Theme::light);
  draw_head(svg, title, about);
  double left = kMarginPx + 50;
  for (const std::size_t up : {std::size_t{1}, std::size_t{2}}) {
    const Panel panel = panel_in_proportion({left, top}, range_in_view(rig, 0, span),
                                            range_in_view(rig, up, span), kViewPx);
    svg.data("panel", up == 1 ? "XY" : "XZ");
    svg.begin_group();
    draw_axes(svg, panel, "X_mm");
    draw_y_title(svg, panel, up == 1 ? "Y_mm" : "Z_mm");
    for (std::size_t k = 0; k < rig.probes.size(); ++k) draw_probe(svg, panel, rig, k, up);
    draw_dimensions(svg, panel, rig, 0);
    draw_dimensions(svg, panel, rig, up);
    svg.end_group();
    left += kViewPx + 90;
  }
  draw_notes(svg, top + kViewPx + 50, notes);
  return svg.take();
}

}  // namespace mdof::charts
