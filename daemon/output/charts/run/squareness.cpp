// The chart of the squareness of two axes: both axes relative to the square, with enlarged errors.
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

constexpr double kPicturePx = 430, kPictureLegendPx = 62;
constexpr double kErrorShare = 0.25;  // ratio of the largest drawn error to the length of an axis

// One axis along the travel of its moving body: positions, errors (positive towards + of the other
// axis), and the line through the errors, which begins at 0.
struct AxisPath {
  std::vector<double> along_mm, across_um;
  double from_mm = 0, to_mm = 0, slope_um_per_mm = 0;
  double line_um(double at_mm) const { return slope_um_per_mm * (at_mm - from_mm); }
};

AxisPath path_of(const Run& run, std::size_t named, double slope_rad, double turned_rad) {
  AxisPath path;
  const MovingAxis moving = run.header.moving();
  std::vector<algo::TargetMean> means =
      algo::target_means(moving, run.points, algo::Approach::both);
  if (means.empty()) return path;
  const auto along = [&](const algo::TargetMean& m) {
    return moving.sides.moving_body_travel_m(m.position_m);
  };
  std::stable_sort(means.begin(), means.end(),
                   [&](const auto& a, const auto& b) { return along(a) < along(b); });
  path.from_mm = to_mm(along(means.front()));
  path.to_mm = to_mm(along(means.back()));
  path.slope_um_per_mm = (slope_rad + turned_rad) * 1e3;
  double mean_left = 0;  // mean residual from the line; it is subtracted from all points
  for (const algo::TargetMean& m : means) {
    path.along_mm.push_back(to_mm(along(m)));
    path.across_um.push_back(to_um(m.named[named] + turned_rad * along(m)));
    mean_left += (path.across_um.back() - path.line_um(path.along_mm.back())) /
                 static_cast<double>(means.size());
  }
  for (double& across : path.across_um) across -= mean_left;
  return path;
}

// The factor by which the errors are enlarged. It is a round number, and the largest error becomes
// about kErrorShare of an axis.
double enlargement(const AxisPath& x, const AxisPath& y) {
  double largest_um = 0;
  for (const AxisPath* path : {&x, &y}) {
    for (const double across : path->across_um) largest_um = std::max(largest_um, std::abs(across));
    largest_um = std::max(largest_um, std::abs(path->line_um(path->to_mm)));
  }
  const double length_mm = std::max({x.to_mm - x.from_mm, y.to_mm - y.from_mm, 1e-3});
  if (!(largest_um > 0)) return 1;
  return round_step(kErrorShare * length_mm * 1e3 / largest_um) / 2;
}

struct Picture {
  Panel panel;
  double factor = 1, x0_mm = 0, y0_mm = 0;
  // A point of the axis X, which is horizontal and begins at 0. A positive error (towards + of Y)
  // points upwards.
  Place on_x(double along_mm, double across_um) const {
    return panel.at(along_mm - x0_mm, across_um * factor / 1e3);
  }
  Place on_y(double along_mm, double across_um) const {
    return panel.at(across_um * factor / 1e3, along_mm - y0_mm);
  }
};

Picture picture_of(const AxisPath& x, const AxisPath& y, double top) {
  Picture picture;
  picture.factor = enlargement(x, y);
  picture.x0_mm = x.from_mm;
  picture.y0_mm = y.from_mm;
  const double length = std::max({x.to_mm - x.from_mm, y.to_mm - y.from_mm, 1e-3});
  Range across, up;
  for (Range* range : {&across, &up}) {
    range->include(-0.35 * length);
    range->include(1.1 * length);
  }
  picture.panel.width = picture.panel.height = kPicturePx;  // the same scale for both axes
  picture.panel.corner = {kMarginPx + 40, top};
  picture.panel.x = horizontal_axis(across, kPicturePx);
  picture.panel.y = vertical_axis(up, kPicturePx);
  return picture;
}

template <class On>
void draw_path(Svg& svg, const AxisPath& path, On on, int direction, const char* name) {
  std::vector<Place> line;
  for (std::size_t i = 0; i < path.along_mm.size(); ++i)
    line.push_back(on(path.along_mm[i], path.across_um[i]));
  svg.line("rule dash", on(path.from_mm, 0), on(path.to_mm, 0));
  svg.data("line", name).data("slope-urad", path.slope_um_per_mm * 1e3);
  svg.line("ink", on(path.from_mm, 0), on(path.to_mm, path.line_um(path.to_mm)));
  if (line.size() > 1 && line.size() <= kMostMarks) svg.polyline(line_of(direction), line);
  for (std::size_t i = 0; i < std::min(path.along_mm.size(), kMostMarks); ++i) {
    const Place at = on(path.along_mm[i], path.across_um[i]);
    svg.data("axis", name).data("along-mm", path.along_mm[i]);
    svg.data("across-um", path.across_um[i]);
    if (direction > 0)
      svg.dot("blue-dot", at, 3);
    else
      svg.rect("orange hollow", {at.x - 3, at.y - 3}, 6, 6);
  }
}

}  // namespace

std::string squareness_svg(const SquarenessResults& results, Language language) {
  const Squareness& s = results.squareness;
  const Budget& b = results.budget;
  // The readings against the second face of the square are turned by the angle error of the square.
  const std::string name = squareness_name(s.axes);
  const std::string a(1, letter(s.axes.a)), b_axis(1, letter(s.axes.b));
  const AxisPath x =
      path_of(results.run_a, straightness_along(s.axes.a, s.axes.b), s.slope_a_rad, 0);
  const AxisPath y = path_of(results.run_b, straightness_along(s.axes.b, s.axes.a), s.slope_b_rad,
                             -s.artefact.corner * s.artefact.angle_error_rad);
  std::vector<std::string> of_runs = daemon::warning_marks(results.run_a, language);
  for (std::string& mark : daemon::warning_marks(results.run_b, language))
    of_runs.push_back(std::move(mark));
  const std::vector<std::string> marks = with_noise_only_mark(b.noise_only, of_runs, language);
  const std::string title = phrase(Phrase::squareness_of_runs, language,
                                   {std::to_string(s.run_a), std::to_string(s.run_b), a, b_axis});
  const double U = to_urad(b.U);
  const std::string angle =
      name + " = " + value_text(to_urad(s.error_rad), to_urad(b.u)) + " µrad, " +
      (U > 0 ? phrase(Phrase::U_and_k, language,
                      {uncertainty_text(U) + " µrad", fixed_text(b.coverage_factor, 2)})
             : std::string(phrase(Phrase::U_is_unknown, language)));
  const double top = run_head_height(marks) + kPictureLegendPx;
  const Picture picture = picture_of(x, y, top);
  const std::vector<std::string> notes = {
      phrase(Phrase::enlarged, language, {number_text(picture.factor, 6)}),
      phrase(Phrase::squareness_sense, language,
             {name, a, b_axis, squareness_sign(s.axes) > 0 ? "+" : "−"}),
      phrase(Phrase::u_covers, language, {words::text(covers(b), language)})};
  Svg svg(kWidthPx, top + kPicturePx + 44 + notes_height(notes) + 12, title, angle, Theme::light);
  draw_run_head(svg, title, angle, marks, language);
  const auto run_of = [&](const char* error, std::int64_t run) {
    return phrase(Phrase::error_of_run, language, {error, std::to_string(run)});
  };
  const std::array<LegendItem, 4> lines = {
      {{LegendSign::line, "blue thin", run_of(s.straightness_a(), s.run_a)},
       {LegendSign::line, "orange dash thin", run_of(s.straightness_b(), s.run_b)},
       {LegendSign::line, "ink", phrase(Phrase::least_squares, language)},
       {LegendSign::line, "rule dash", phrase(Phrase::square_axes, language)}}};
  draw_marks_legend(svg, top - kPictureLegendPx, {}, lines, language);
  svg.data("panel", name + "_urad").data("value", to_urad(s.error_rad)).data("U", U);
  svg.data("enlargement", picture.factor);
  svg.begin_group();
  draw_axes(svg, picture.panel, a + "_mm");
  draw_y_title(svg, picture.panel, b_axis + "_mm");
  draw_path(
      svg, x, [&](double along, double c) { return picture.on_x(along, c); }, 1, a.c_str());
  draw_path(
      svg, y, [&](double along, double c) { return picture.on_y(along, c); }, -1, b_axis.c_str());
  const double right = picture.panel.corner.x + kPicturePx + 24;
  svg.text("text title", {right, top + 60}, Anchor::start, name);
  svg.text("text", {right, top + 86}, Anchor::start,
           value_text(to_urad(s.error_rad), to_urad(b.u)) + " µrad");
  svg.text("text", {right, top + 108}, Anchor::start,
           U > 0 ? "U = " + uncertainty_text(U) + " µrad" : phrase(Phrase::U_is_unknown, language));
  svg.end_group();
  draw_notes(svg, top + kPicturePx + 40, notes);
  return svg.take();
}

}  // namespace mdof::charts
