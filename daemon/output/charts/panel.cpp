#include "daemon/output/charts/panel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/style.h"

namespace mdof::charts {
namespace {

constexpr double kSignPx = 26, kItemGapPx = 22, kLegendRowPx = 20;  // dimensions of a legend
constexpr double kAbovePx = 34, kBelowPx = 48, kGapPx = 28;         // margins around a panel

constexpr double kBold = 1.12;  // ratio of the widths of bold and normal letters

std::string fitting(std::string_view text, double font_px, double room_px) {
  std::string whole(text);
  for (std::size_t n = text.size(); n > 1 && text_width(whole, font_px) > room_px; --n)
    whole = shortened(text, n);
  return whole;
}

void draw_sign(Svg& svg, const LegendItem& item, Place left) {
  const double y = left.y - 4;
  if (item.sign == LegendSign::area) svg.rect(item.mark, {left.x, y - 5}, kSignPx - 6, 10);
  if (item.sign == LegendSign::line) svg.line(item.mark, {left.x, y}, {left.x + kSignPx - 6, y});
  if (item.sign == LegendSign::dot) svg.dot(item.mark, {left.x + (kSignPx - 6) / 2, y}, 3);
}

// Calls draw() for each group of neighbouring steps without a gap between them.
template <class Draw>
void for_each_run(std::span<const Step> steps, Draw draw) {
  const auto known = [](const Step& s) { return std::isfinite(s.low) && std::isfinite(s.high); };
  for (std::size_t begin = 0; begin < steps.size();) {
    std::size_t end = begin;
    while (end < steps.size() && known(steps[end])) ++end;
    if (end > begin) draw(steps.subspan(begin, end - begin));
    begin = end + 1;
  }
}

}  // namespace

void draw_head(Svg& svg, std::string_view title, std::string_view subtitle) {
  const double room = kWidthPx - 2 * kMarginPx;
  svg.text("text title", {kMarginPx, 30}, Anchor::start, fitting(title, kBold * kTitlePx, room));
  svg.text("quiet", {kMarginPx, 50}, Anchor::start, fitting(subtitle, kTextPx, room));
}

std::string titled(const StudyResult& result, const std::string& what) {
  return result.name.empty() ? what : shortened(result.name, 32) + ": " + what;
}

std::string study_line(const StudyResult& result) {
  std::string line =
      "Monte Carlo, " + count_text(result.trials) + " trials, seed " + std::to_string(result.seed);
  if (result.state == StudyState::interrupted)
    line += "; interrupted, " + count_text(result.trials_wanted) + " trials were requested";
  return line;
}

double draw_legend(Svg& svg, double top, std::span<const LegendItem> items) {
  Place place{kMarginPx, top + 14};
  for (const LegendItem& item : items) {
    const double width = kSignPx + text_width(item.text, kTextPx);
    if (place.x > kMarginPx && place.x + width > kWidthPx - kMarginPx)
      place = {kMarginPx, place.y + kLegendRowPx};
    draw_sign(svg, item, place);
    svg.text("text", {place.x + kSignPx, place.y}, Anchor::start, item.text);
    place.x += width + kItemGapPx;
  }
  return place.y + 6;
}

Panel panel_in_proportion(Place corner, const Range& x, const Range& y, double longest_px) {
  const double px_per_unit = longest_px / std::max(x.span(), y.span());
  Panel panel;
  panel.corner = corner;
  panel.width = x.span() * px_per_unit;
  panel.height = y.span() * px_per_unit;
  panel.x = horizontal_axis(x, panel.width);
  panel.y = vertical_axis(y, panel.height);
  return panel;
}

void draw_axes(Svg& svg, const Panel& panel, std::string_view x_key) {
  const double left = panel.corner.x, right = left + panel.width;
  const double top = panel.corner.y, bottom = top + panel.height;
  for (const Tick& tick : panel.x.ticks) {
    const double x = panel.px_x(tick.at);
    svg.line("grid", {x, top}, {x, bottom});
    svg.text("quiet tick", {x, bottom + 16}, Anchor::middle, tick.label);
  }
  for (const Tick& tick : panel.y.ticks) {
    const double y = panel.px_y(tick.at);
    svg.line("grid", {left, y}, {right, y});
    svg.text("quiet tick", {left - 6, y + 4}, Anchor::end, tick.label);
  }
  svg.line("rule", {left, bottom}, {right, bottom});
  svg.text("quiet", {right, bottom + 34}, Anchor::end,
           fitting(key_label(x_key, panel.x.exponent), kTextPx, panel.width));
}

void draw_y_title(Svg& svg, const Panel& panel, std::string_view y_key) {
  const double left = panel.corner.x - widest_label(panel.y) - 6;
  svg.text("text head", {left, panel.corner.y - 12}, Anchor::start,
           fitting(key_label(y_key, panel.y.exponent), kBold * kTextPx,
                   panel.corner.x + panel.width - left));
}

Sheet::Sheet(double top_px, std::span<const Range> y_ranges, double panel_height_px)
    : top_(top_px), height_(panel_height_px), columns_(y_ranges.size() > 1 ? 2 : 1) {
  for (const Range& range : y_ranges) {
    y_.push_back(vertical_axis(range, height_));
    left_ = std::max(left_, widest_label(y_.back()) + 6);
  }
}

Panel Sheet::panel(std::size_t i, const Range& x, bool logarithmic_x) const {
  const auto columns = static_cast<double>(columns_);
  const double cell = (kWidthPx - 2 * kMarginPx - (columns - 1) * kGapPx) / columns;
  const std::size_t row_number = i / columns_;
  const auto column = static_cast<double>(i % columns_), row = static_cast<double>(row_number);
  Panel panel;
  panel.corner = {kMarginPx + column * (cell + kGapPx) + left_,
                  top_ + row * (kAbovePx + height_ + kBelowPx) + kAbovePx};
  panel.width = std::max(cell - left_, 40.0);
  panel.height = height_;
  panel.x = logarithmic_x ? logarithmic_axis(x, panel.width) : horizontal_axis(x, panel.width);
  panel.y = y_[i];
  return panel;
}

double Sheet::bottom() const {
  const std::size_t rows = (y_.size() + columns_ - 1) / columns_;
  return top_ + static_cast<double>(rows) * (kAbovePx + height_ + kBelowPx);
}

void draw_band(Svg& svg, const Panel& panel, std::string_view mark, std::span<const Step> steps) {
  for_each_run(steps, [&](std::span<const Step> run) {
    std::vector<Place> outline;
    for (const Step& s : run) {
      outline.push_back(panel.at(s.from, s.high));
      outline.push_back(panel.at(s.to, s.high));
    }
    for (auto s = run.rbegin(); s != run.rend(); ++s) {
      outline.push_back(panel.at(s->to, s->low));
      outline.push_back(panel.at(s->from, s->low));
    }
    svg.polygon(mark, outline);
  });
}

void draw_steps(Svg& svg, const Panel& panel, std::string_view mark, std::span<const Step> steps) {
  for_each_run(steps, [&](std::span<const Step> run) {
    std::vector<Place> line;
    for (const Step& s : run) {
      line.push_back(panel.at(s.from, s.low));
      line.push_back(panel.at(s.to, s.low));
    }
    svg.polyline(mark, line);
  });
}

}  // namespace mdof::charts
