// The plot of an allocation of two tolerances. The frontier shows, for each value of the first
// tolerance, the largest second tolerance at which the output is still within its limit.
#include <algorithm>
#include <cmath>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/study/charts.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr double kFrontierPx = 220;

struct Point {
  double first = 0;
  AllocatedTolerance second;
};
// One pair of tolerances of an allocation. The points are in ascending order of the first
// tolerance.
struct Frontier {
  const Allocation* allocation = nullptr;
  std::string first_key, second_key;
  std::vector<Point> points;
};

bool is_point(const std::vector<AllocatedTolerance>& pair) {
  return pair.size() == 2 && std::isfinite(pair[0].value) && std::isfinite(pair[1].value);
}

void add_point(std::vector<Frontier>& all, const Allocation& allocation,
               const std::vector<AllocatedTolerance>& pair) {
  const auto same = [&](const Frontier& f) {
    return f.allocation == &allocation && f.first_key == pair[0].tolerance &&
           f.second_key == pair[1].tolerance;
  };
  auto at = std::find_if(all.begin(), all.end(), same);
  if (at == all.end())
    at = all.insert(all.end(), Frontier{&allocation, pair[0].tolerance, pair[1].tolerance, {}});
  at->points.push_back({pair[0].value, pair[1]});
}

// Whether some points of a frontier are not drawn. If the second tolerance has no influence, its
// value is infinite, and the point is not drawn.
bool leaves_some_out(const StudyResult& result) {
  const auto left_out = [](const Allocation& a) {
    return std::any_of(a.frontier.begin(), a.frontier.end(),
                       [](const auto& pair) { return pair.size() == 2 && !is_point(pair); });
  };
  return std::any_of(result.allocations.begin(), result.allocations.end(), left_out);
}

std::vector<Frontier> frontiers(const StudyResult& result) {
  std::vector<Frontier> all;
  for (const Allocation& allocation : result.allocations)
    for (const auto& pair : allocation.frontier)
      if (is_point(pair)) add_point(all, allocation, pair);
  for (Frontier& f : all)
    std::stable_sort(f.points.begin(), f.points.end(),
                     [](const Point& a, const Point& b) { return a.first < b.first; });
  return all;
}

bool has_uncertainty(const AllocatedTolerance& t) {
  return t.low < t.high && t.low <= t.value && t.value <= t.high;
}

bool has_interval(const Frontier& f) {
  return std::any_of(f.points.begin(), f.points.end(),
                     [](const Point& p) { return has_uncertainty(p.second); });
}

Range first_range(const Frontier& f) {
  Range x;
  x.include(0);
  for (const Point& p : f.points) x.include(p.first * 1.05);
  return x;
}

Range second_range(const Frontier& f) {
  Range y;
  y.include(0);
  for (const Point& p : f.points) {
    y.include(p.second.value * 1.05);
    if (has_uncertainty(p.second)) y.include(p.second.high * 1.05);
  }
  return y;
}

// Draws the area below the frontier. At all points in this area the output is within its limit.
void draw_allowed(Svg& svg, const Panel& panel, const Frontier& f) {
  std::vector<Place> line;
  for (const Point& p : f.points) line.push_back(panel.at(p.first, p.second.value));
  std::vector<Place> area = line;
  area.push_back(panel.at(f.points.back().first, 0));
  area.push_back(panel.at(f.points.front().first, 0));
  svg.polygon("wide", area);
  svg.polyline("blue", line);
  for (const Place& place : line) svg.dot("blue-dot", place, 3);
}

void draw_uncertainty(Svg& svg, const Panel& panel, const Point& p) {
  if (!has_uncertainty(p.second)) return;
  const Place low = panel.at(p.first, p.second.low), high = panel.at(p.first, p.second.high);
  svg.line("ink", low, high);
  for (const Place& end : {low, high}) svg.line("ink", {end.x - 3, end.y}, {end.x + 3, end.y});
}

std::string condition(const Allocation& a) {
  const auto [name, unit] = split_key(a.output);
  return "P(|" + name + "| ≤ " + number_text(a.limit) + (unit.empty() ? "" : "\u00a0" + unit) +
         ") ≥ " + number_text(100 * a.probability) + "\u00a0%";
}

std::string in_words(const StudyResult& result, const std::vector<Frontier>& all) {
  std::string words = study_line(result) + ".";
  for (const Frontier& f : all) {
    const Point& p = f.points.front();
    words += " " + condition(*f.allocation) + ": " + key_label(f.first_key) + " = " +
             number_text(p.first) + " allows " + key_label(f.second_key) + " up to " +
             number_text(p.second.value) + ".";
  }
  return words;
}

void draw_frontier(Svg& svg, const Panel& panel, const Frontier& f) {
  draw_axes(svg, panel, f.first_key);
  draw_y_title(svg, panel, f.second_key);
  draw_allowed(svg, panel, f);
  for (const Point& p : f.points) draw_uncertainty(svg, panel, p);
  svg.text("text halo", {panel.corner.x + panel.width, panel.corner.y + 14}, Anchor::end,
           "permitted if " + condition(*f.allocation));
}

}  // namespace

bool has_frontier(const StudyResult& result) {
  return !frontiers(result).empty();
}

std::string frontier_svg(const StudyResult& result) {
  const std::vector<Frontier> all = frontiers(result);
  std::vector<Range> y;
  for (const Frontier& f : all) y.push_back(second_range(f));
  const Sheet sheet(kHeadPx + 24, y, kFrontierPx);
  const std::string title = titled(result, "permitted pairs of tolerances");
  const bool some_left_out = leaves_some_out(result);
  Svg svg(kWidthPx, sheet.bottom() + (some_left_out ? 24 : 4), title, in_words(result, all));
  draw_head(svg, title, study_line(result));
  std::vector<LegendItem> legend = {
      {LegendSign::line, "blue", "largest permitted tolerance on the vertical axis"},
      {LegendSign::area, "wide", "permitted pairs"}};
  if (std::any_of(all.begin(), all.end(), has_interval))
    legend.push_back({LegendSign::line, "ink",
                      "95\u00a0% interval of the largest tolerance (sampling uncertainty)"});
  draw_legend(svg, kHeadPx, legend);
  for (std::size_t i = 0; i < all.size(); ++i)
    draw_frontier(svg, sheet.panel(i, first_range(all[i]), false), all[i]);
  if (some_left_out)
    svg.text("quiet", {kMarginPx, sheet.bottom() + 8}, Anchor::start,
             "Points where the tolerance on the vertical axis has no upper limit are not drawn.");
  return svg.take();
}

}  // namespace mdof::charts
