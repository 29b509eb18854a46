// The plot of each output against the binned quantity, which is usually the travel: mean, coverage
// interval and extremes of each bin.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/study/charts.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// The plot shows extremes up to this distance from the intervals, in multiples of the range of all
// intervals. If it showed all extremes, the intervals could be too small to be visible.
constexpr double kMostExtremeDistance = 4;

struct BinnedOutput {
  std::string key;
  std::vector<Step> mean, sd, interval, minimum, maximum;
  Range y;
  bool cut = false;  // true: an extreme is outside the range y
};

const OutputSummary* find(const StudyBin& bin, const std::string& key) {
  const auto found = std::find_if(bin.outputs.begin(), bin.outputs.end(),
                                  [&](const OutputSummary& o) { return o.key == key; });
  return found == bin.outputs.end() || found->n == 0 ? nullptr : &*found;
}

// Adds one bin. A bin without a solved trial makes a gap.
void add_bin(BinnedOutput& out, const StudyBin& bin) {
  const auto add = [&](std::vector<Step>& steps, double low, double high) {
    steps.push_back({bin.from, bin.to, low, high});
  };
  const OutputSummary* o = find(bin, out.key);
  add(out.mean, o ? o->mean : kNaN, o ? o->mean : kNaN);
  add(out.sd, o ? o->mean - o->sd : kNaN, o ? o->mean + o->sd : kNaN);
  add(out.interval, o ? o->symmetric.low : kNaN, o ? o->symmetric.high : kNaN);
  add(out.minimum, o ? o->min : kNaN, o ? o->min : kNaN);
  add(out.maximum, o ? o->max : kNaN, o ? o->max : kNaN);
}

void include(Range& range, const std::vector<Step>& steps) {
  for (const Step& s : steps) {
    range.include(s.low);
    range.include(s.high);
  }
}

void choose_range(BinnedOutput& out) {
  Range body, all;
  for (const auto* steps : {&out.mean, &out.sd, &out.interval}) include(body, *steps);
  all = body;
  include(all, out.minimum);
  include(all, out.maximum);
  const double far = kMostExtremeDistance * body.span();
  out.cut = far > 0 && (all.high > body.high + far || all.low < body.low - far);
  out.y = all;
  if (out.cut)
    out.y = {std::max(all.low, body.low - far), std::min(all.high, body.high + far), false};
  out.y = padded(out.y, 0.04);
}

std::vector<BinnedOutput> binned_outputs(const StudyResult& result) {
  std::vector<BinnedOutput> all;
  for (const OutputSummary& o : result.bins.front().outputs) {
    BinnedOutput out;
    out.key = o.key;
    for (const StudyBin& bin : result.bins) add_bin(out, bin);
    choose_range(out);
    all.push_back(std::move(out));
  }
  return all;
}

std::array<LegendItem, 4> marks_legend(const StudyResult& result) {
  const double coverage = result.bins.front().outputs.front().coverage;
  return {
      {{LegendSign::line, "ink", "mean"},
       {LegendSign::area, "narrow", "± sd"},
       {LegendSign::area, "wide", "symmetric " + number_text(100 * coverage) + "\u00a0% interval"},
       {LegendSign::line, "edge dot", "extremes"}}};
}

void draw_output(Svg& svg, const Panel& panel, const BinnedOutput& out, std::string_view x_key) {
  draw_axes(svg, panel, x_key);
  draw_y_title(svg, panel, out.key);
  draw_band(svg, panel, "wide", out.interval);
  draw_band(svg, panel, "narrow", out.sd);
  draw_steps(svg, panel, "edge dot", out.minimum);
  draw_steps(svg, panel, "edge dot", out.maximum);
  draw_steps(svg, panel, "ink", out.mean);
}

std::string in_words(const StudyResult& result, const std::vector<BinnedOutput>& outputs) {
  std::string words = study_line(result) + ". For each of " + count_text(result.bins.size()) +
                      " bins, the chart shows the mean, the mean ± sd, the symmetric coverage "
                      "interval and the extremes.";
  for (const BinnedOutput& out : outputs) {
    const auto sd = [](const Step& s) { return number_text((s.high - s.low) / 2); };
    words += " " + key_label(out.key) + ": sd " + sd(out.sd.front()) + " in the first bin, " +
             sd(out.sd.back()) + " in the last.";
  }
  return words;
}

}  // namespace

bool has_bins(const StudyResult& result) {
  return !result.binned_key.empty() && !result.bins.empty() && !result.bins.front().outputs.empty();
}

std::string bins_svg(const StudyResult& result) {
  const std::vector<BinnedOutput> outputs = binned_outputs(result);
  Range x;
  std::vector<Range> y;
  for (const StudyBin& bin : result.bins) {
    x.include(bin.from);
    x.include(bin.to);
  }
  for (const BinnedOutput& out : outputs) y.push_back(out.y);
  const Sheet sheet(kHeadPx + 24, y, kOutputPx);
  const bool cut = std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return o.cut; });
  const std::string title = titled(result, "errors against " + split_key(result.binned_key).name);
  Svg svg(kWidthPx, sheet.bottom() + (cut ? 24 : 4), title, in_words(result, outputs));
  draw_head(svg, title, study_line(result));
  draw_legend(svg, kHeadPx, marks_legend(result));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    draw_output(svg, sheet.panel(i, x, false), outputs[i], result.binned_key);
  if (cut)
    svg.text("quiet", {kMarginPx, sheet.bottom() + 8}, Anchor::start,
             "An extreme value outside the range of a panel is drawn at the edge of that panel.");
  return svg.take();
}

}  // namespace mdof::charts
