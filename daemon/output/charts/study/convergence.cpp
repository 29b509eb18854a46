// The plot of the convergence of each output: the difference of its figures from their last values,
// against the number of trials.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/study/charts.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr std::size_t kMostDots = 40;

struct Figure {
  double ConvergencePoint::*value;
  const char* line;
  const char* dot;
  const char* name;
};
constexpr std::array<Figure, 4> kFigures = {
    {{&ConvergencePoint::mean, "ink", "ink-dot", "mean"},
     {&ConvergencePoint::sd, "edge dash", "quiet", "sd"},
     {&ConvergencePoint::low, "blue", "blue-dot", "lower end of the coverage interval"},
     {&ConvergencePoint::high, "orange dot", "orange-dot", "upper end of the coverage interval"}}};

std::vector<const Convergence*> drawn(const StudyResult& result) {
  std::vector<const Convergence*> all;
  for (const Convergence& c : result.convergence)
    if (!c.points.empty()) all.push_back(&c);
  return all;
}

double final_value(const Convergence& c, const Figure& figure) {
  return c.points.back().*figure.value;
}

Range range_of(const Convergence& c) {
  Range range;
  for (const Figure& figure : kFigures)
    for (const ConvergencePoint& p : c.points)
      range.include(p.*figure.value - final_value(c, figure));
  return padded(range, 0.06);
}

void draw_figure(Svg& svg, const Panel& panel, const Convergence& c, const Figure& figure) {
  std::vector<Place> places;
  for (const ConvergencePoint& p : c.points) {
    const double difference = p.*figure.value - final_value(c, figure);
    if (std::isfinite(difference))
      places.push_back(panel.at(static_cast<double>(p.trials), difference));
  }
  if (places.size() > 1) svg.polyline(figure.line, places);
  if (places.size() > kMostDots) return;
  for (const Place& place : places) svg.dot(figure.dot, place, 2.4);
}

std::string last_values(const Convergence& c) {
  const ConvergencePoint& p = c.points.back();
  return key_label(c.key) + " over all trials: mean " + number_text(p.mean) + ", sd " +
         number_text(p.sd) + ", coverage interval [" + number_text(p.low) + ", " +
         number_text(p.high) + "]";
}

}  // namespace

bool has_convergence(const StudyResult& result) {
  return !drawn(result).empty();
}

std::string convergence_svg(const StudyResult& result) {
  const std::vector<const Convergence*> all = drawn(result);
  std::vector<Range> y;
  Range x;
  std::string words = study_line(result) + ".";
  for (const Convergence* c : all) {
    y.push_back(range_of(*c));
    for (const ConvergencePoint& p : c->points)
      if (p.trials > 0) x.include(static_cast<double>(p.trials));
    words += " " + last_values(*c) + ".";
  }
  const Sheet sheet(kHeadPx + 24, y, kOutputPx);
  const std::string title = titled(result, "difference from the final value");
  Svg svg(kWidthPx, sheet.bottom() + 4, title, words);
  draw_head(svg, title, study_line(result));
  std::vector<LegendItem> legend;
  for (const Figure& figure : kFigures)
    legend.push_back({LegendSign::line, figure.line, figure.name});
  draw_legend(svg, kHeadPx, legend);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Panel panel = sheet.panel(i, x, true);
    draw_axes(svg, panel, "trials");
    draw_y_title(svg, panel, all[i]->key);
    for (const Figure& figure : kFigures) draw_figure(svg, panel, *all[i], figure);
  }
  return svg.take();
}

}  // namespace mdof::charts
