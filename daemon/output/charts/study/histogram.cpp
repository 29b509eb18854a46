// The plot of the distribution of one output: the histogram, and above it the mean and the coverage
// intervals on the same axis.
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

constexpr double kIntervalPx = 22, kBarsPx = 250, kLeftPx = 132;

// An interval above the histogram. Its name is at the left, its figures are at the right.
struct Row {
  std::string name, figures;
  const char* mark;   // CSS class of the line of the interval
  const char* guide;  // CSS class of the vertical lines from its ends through the histogram
  double low, high;
};

std::string interval_text(const CoverageInterval& interval) {
  return "[" + number_text(interval.low) + ", " + number_text(interval.high) + "]";
}

std::array<Row, 3> rows_of(const OutputSummary& o) {
  const std::string percent = " " + number_text(100 * o.coverage) + "\u00a0%";
  return {{{"mean ± sd", number_text(o.mean) + " ± " + number_text(o.sd), "ink", "ink",
            o.mean - o.sd, o.mean + o.sd},
           {"symmetric" + percent, interval_text(o.symmetric), "blue", "blue dash", o.symmetric.low,
            o.symmetric.high},
           {"shortest" + percent, interval_text(o.shortest), "orange", "orange dot", o.shortest.low,
            o.shortest.high}}};
}

// The bars of the histogram, with their share of the solved trials in %. If all values are equal,
// the only bar has no width; it is then drawn with 1/20 of the width of the axis.
std::vector<Step> bars_of(const OutputSummary& o) {
  const Histogram& h = o.histogram;
  const bool flat = !(h.width > 0) || !std::isfinite(h.width);
  const Range around = padded({h.from, h.from, false}, 0);
  std::vector<Step> bars;
  for (std::size_t i = 0; i < h.counts.size(); ++i) {
    const double share = 100 * static_cast<double>(h.counts[i]) / static_cast<double>(o.n);
    const double from =
        flat ? h.from - around.span() / 40 : h.from + h.width * static_cast<double>(i);
    const double to = flat ? h.from + around.span() / 40 : from + h.width;
    bars.push_back({from, to, 0, share});
  }
  return bars;
}

Range drawn_x(const OutputSummary& o, const std::vector<Step>& bars) {
  Range x;
  x.include(bars.front().from);
  x.include(bars.back().to);
  if (x.span() > 0 && o.histogram.width > 0) return padded(x, 0.02);
  return padded({o.histogram.from, o.histogram.from, false}, 0);
}

void draw_row(Svg& svg, const Panel& panel, const Row& row, double y) {
  svg.text("text", {panel.corner.x - 12, y + 4}, Anchor::end, row.name);
  svg.text("text", {panel.corner.x + panel.width + 12, y + 4}, Anchor::start, row.figures);
  if (!std::isfinite(row.low) || !std::isfinite(row.high)) return;
  svg.line(row.mark, {panel.px_x(row.low), y}, {panel.px_x(row.high), y});
  for (const double end : {row.low, row.high})
    if (end >= panel.x.low && end <= panel.x.high)
      svg.line(row.mark, {panel.px_x(end), y - 5}, {panel.px_x(end), y + 5});
}

void draw_guide(Svg& svg, const Panel& panel, const char* mark, double value, double from_y) {
  if (!(value >= panel.x.low && value <= panel.x.high)) return;
  const double x = panel.px_x(value);
  svg.line(mark, {x, from_y}, {x, panel.corner.y + panel.height});
}

void draw_rows(Svg& svg, const Panel& panel, const OutputSummary& o) {
  double y = kHeadPx + 16;
  for (const Row& row : rows_of(o)) {
    draw_row(svg, panel, row, y);
    if (row.guide == std::string_view("ink")) {
      draw_guide(svg, panel, row.guide, o.mean, y);
      if (std::isfinite(o.mean)) svg.dot("ink-dot", {panel.px_x(o.mean), y}, 4);
    } else {
      draw_guide(svg, panel, row.guide, row.low, y);
      draw_guide(svg, panel, row.guide, row.high, y);
    }
    y += kIntervalPx;
  }
}

std::string extremes_line(const OutputSummary& o) {
  std::string line = "min " + number_text(o.min) + ", max " + number_text(o.max);
  if (o.histogram.width > 0) line += "; bars " + number_text(o.histogram.width) + " wide";
  return line;
}

// A text with the number of trials that the histogram does not show; "" if it shows all trials.
std::string missing_line(const OutputSummary& o) {
  std::string line;
  if (o.histogram.below + o.histogram.above > 0)
    line = count_text(o.histogram.below) + " trials lie below the drawn range, " +
           count_text(o.histogram.above) + " above";
  if (o.unsolved > 0)
    line += (line.empty() ? "" : "; ") + count_text(o.unsolved) + " trials have no solution";
  return line;
}

std::string in_words(const StudyResult& result, const OutputSummary& o) {
  std::string words = study_line(result) + ". " + key_label(o.key) + ": ";
  for (const Row& row : rows_of(o)) words += row.name + " " + row.figures + "; ";
  return words + extremes_line(o) + ". " + missing_line(o);
}

// The right margin is wide enough for the figures of the intervals.
Panel panel_of(const OutputSummary& o, const std::vector<Step>& bars) {
  double right = 0;
  for (const Row& row : rows_of(o)) right = std::max(right, text_width(row.figures, kTextPx));
  Range y;
  y.include(0);
  for (const Step& bar : bars) y.include(bar.high * 1.05);
  if (y.high == 0) y.include(1);
  Panel panel;
  panel.corner = {kLeftPx + kMarginPx, kHeadPx + 3 * kIntervalPx + 40};
  panel.width = kWidthPx - panel.corner.x - kMarginPx - 12 - right;
  panel.height = kBarsPx;
  panel.x = horizontal_axis(drawn_x(o, bars), panel.width);
  panel.y = vertical_axis(y, panel.height);
  return panel;
}

}  // namespace

bool has_histogram(const OutputSummary& output) {
  return output.n > 0 && !output.histogram.counts.empty() && std::isfinite(output.histogram.from);
}

std::string histogram_svg(const StudyResult& result, const OutputSummary& output) {
  const std::vector<Step> bars = bars_of(output);
  const Panel panel = panel_of(output, bars);
  const std::string title = titled(result, key_label(output.key));
  const double bottom = panel.corner.y + panel.height;
  const std::string missing = missing_line(output);
  Svg svg(kWidthPx, bottom + (missing.empty() ? 74 : 92), title, in_words(result, output));
  draw_head(svg, title, study_line(result));
  draw_axes(svg, panel, output.key);
  svg.text("text", {panel.corner.x - 12, panel.corner.y - 12}, Anchor::end, "share of trials / %");
  draw_band(svg, panel, "narrow", bars);
  draw_rows(svg, panel, output);
  svg.text("quiet", {kMarginPx, bottom + 58}, Anchor::start, extremes_line(output));
  svg.text("quiet", {kMarginPx, bottom + 76}, Anchor::start, missing);
  return svg.take();
}

}  // namespace mdof::charts
