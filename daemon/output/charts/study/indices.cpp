// The plot of the sensitivity indices of each output: bars of the first-order index and of the
// total index of every cause.
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

constexpr double kCausePx = 30, kBarPx = 9, kAboveCausesPx = 40, kBelowCausesPx = 52;
constexpr double kFiguresPx = 128;  // width of the column of figures at the right
constexpr std::size_t kMostCauses = 20, kLongestName = 36;

std::size_t shown(const OutputIndices& output) {
  return std::min(output.causes.size(), kMostCauses);
}

double height_of(const OutputIndices& output) {
  return kAboveCausesPx + kCausePx * static_cast<double>(shown(output)) + kBelowCausesPx;
}

std::string with_se(double index, double se) {
  return fixed_text(index, 3) + " ± " + fixed_text(se, 3);
}

// The axis of the indices: 0 to 1, or wider if an estimate is outside this range.
Axis index_axis(const StudyResult& result, double length_px) {
  Range range;
  range.include(0);
  range.include(1);
  for (const OutputIndices& output : result.indices)
    for (const CauseIndex& c : output.causes) {
      range.include(std::clamp(c.first - c.first_se, -1.0, 2.0));
      range.include(std::clamp(c.total + c.total_se, -1.0, 2.0));
    }
  return horizontal_axis(range, length_px);
}

double name_room(const StudyResult& result) {
  double widest = 60;
  for (const OutputIndices& output : result.indices)
    for (std::size_t i = 0; i < shown(output); ++i)
      widest =
          std::max(widest, text_width(shortened(output.causes[i].cause, kLongestName), kTextPx));
  return widest + 10;
}

void draw_bar(Svg& svg, const Panel& panel, const char* mark, double y, double index, double se) {
  if (!std::isfinite(index)) return;
  const double zero = panel.px_x(0), end = panel.px_x(index);
  svg.rect(mark, {std::min(zero, end), y}, std::abs(end - zero), kBarPx);
  if (!(se > 0)) return;
  const double middle = y + kBarPx / 2;
  const double low = panel.px_x(index - se), high = panel.px_x(index + se);
  svg.line("ink", {low, middle}, {high, middle});
  for (const double x : {low, high}) svg.line("ink", {x, middle - 3}, {x, middle + 3});
}

void draw_cause(Svg& svg, const Panel& panel, const CauseIndex& cause, double top) {
  const std::string first = with_se(cause.first, cause.first_se);
  const std::string total = with_se(cause.total, cause.total_se);
  const double right = panel.corner.x + panel.width + kFiguresPx;
  svg.begin_group(cause.cause + ": first order " + first + ", total " + total);
  svg.text("text", {panel.corner.x - 8, top + kCausePx / 2 + 4}, Anchor::end,
           shortened(cause.cause, kLongestName));
  draw_bar(svg, panel, "blue-dot", top + kCausePx / 2 - kBarPx - 1, cause.first, cause.first_se);
  draw_bar(svg, panel, "wide", top + kCausePx / 2 + 1, cause.total, cause.total_se);
  svg.text("text tick", {right, top + kCausePx / 2 - 2}, Anchor::end, first);
  svg.text("quiet tick", {right, top + kCausePx / 2 + 10}, Anchor::end, total);
  svg.end_group();
}

void draw_axis(Svg& svg, const Panel& panel, std::string_view title) {
  const double bottom = panel.corner.y + panel.height;
  for (const Tick& tick : panel.x.ticks) {
    const double x = panel.px_x(tick.at);
    svg.line(tick.at == 0 ? "rule" : "grid", {x, panel.corner.y}, {x, bottom});
    svg.text("quiet tick", {x, bottom + 16}, Anchor::middle, tick.label);
  }
  svg.text("text head", {kMarginPx, panel.corner.y - 12}, Anchor::start, title);
  svg.text("quiet tick", {panel.corner.x + panel.width + kFiguresPx, panel.corner.y - 12},
           Anchor::end, "first order, total");
  svg.text("quiet", {panel.corner.x + panel.width, bottom + 33}, Anchor::end,
           "share of the variance");
}

std::string left_out(const OutputIndices& output) {
  const std::size_t rest = output.causes.size() - shown(output);
  if (rest == 0) return "";
  double largest = 0;
  for (std::size_t i = shown(output); i < output.causes.size(); ++i)
    largest = std::max(largest, output.causes[i].total);
  return std::to_string(rest) + " more causes, each with a total index of at most " +
         fixed_text(largest, 3);
}

void draw_output(Svg& svg, Panel panel, const OutputIndices& output, double top) {
  panel.corner.y = top + kAboveCausesPx;
  panel.height = height_of(output) - kAboveCausesPx - kBelowCausesPx;
  draw_axis(svg, panel, split_key(output.key).name);
  for (std::size_t i = 0; i < shown(output); ++i)
    draw_cause(svg, panel, output.causes[i], panel.corner.y + kCausePx * static_cast<double>(i));
  svg.text("quiet", {kMarginPx, panel.corner.y + panel.height + 33}, Anchor::start,
           left_out(output));
}

std::string in_words(const StudyResult& result) {
  std::string words = study_line(result) + ".";
  for (const OutputIndices& output : result.indices) {
    if (output.causes.empty()) continue;
    const CauseIndex& c = output.causes.front();
    words += " " + split_key(output.key).name + ": largest cause " + c.cause + ", first order " +
             with_se(c.first, c.first_se) + ", total " + with_se(c.total, c.total_se) + ".";
  }
  return words;
}

}  // namespace

bool has_indices(const StudyResult& result) {
  return std::any_of(result.indices.begin(), result.indices.end(),
                     [](const OutputIndices& o) { return !o.causes.empty(); });
}

std::string indices_svg(const StudyResult& result) {
  constexpr double kTop = kHeadPx + 26;
  double height = kTop;
  for (const OutputIndices& output : result.indices) height += height_of(output);
  const std::string title = titled(result, "causes of the scatter");
  Svg svg(kWidthPx, height, title, in_words(result));
  draw_head(svg, title, study_line(result));
  const std::array<LegendItem, 3> legend = {
      {{LegendSign::area, "blue-dot", "first order: effect of the cause alone"},
       {LegendSign::area, "wide", "total: effect including interactions"},
       {LegendSign::line, "ink", "± standard error"}}};
  draw_legend(svg, kHeadPx, legend);
  Panel panel;
  panel.corner.x = kMarginPx + name_room(result);
  panel.width = kWidthPx - kMarginPx - kFiguresPx - panel.corner.x;
  panel.x = index_axis(result, panel.width);
  double top = kTop;
  for (const OutputIndices& output : result.indices) {
    draw_output(svg, panel, output, top);
    top += height_of(output);
  }
  return svg.take();
}

}  // namespace mdof::charts
