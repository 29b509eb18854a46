// The chart of the uncertainty budget of a figure: a bar for each contribution to u.
#include <algorithm>
#include <cmath>
#include <vector>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/axis.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kRowPx = 22, kThickPx = 12, kAboveBarsPx = 30, kBelowBarsPx = 52;
constexpr double kSharePx = 150;
constexpr std::size_t kMostContributors = 12, kLongestContributor = 44;

struct Bar {
  std::string name;
  double value = 0;  // absolute value of the contribution, in the unit of the figure
  double share = 0;
  double contribution = 0;  // with sign
  const char* mark = "blue-dot";
};

// The bars: the largest contributions, then the sum of the other contributions, then u.
std::vector<Bar> contributor_bars(const Budget& budget, Language language) {
  std::vector<Bar> bars;
  double rest = 0, share = 0;
  for (std::size_t i = 0; i < budget.lines.size(); ++i) {
    const BudgetLine& line = budget.lines[i];
    if (i < kMostContributors) {
      const double value = to_key_unit(line.contribution);
      bars.push_back(
          {words::text(line.name, language), std::abs(value), line.share, value, "blue-dot"});
      continue;
    }
    rest += line.contribution * line.contribution;
    share += line.share;
  }
  if (budget.lines.size() > kMostContributors) {
    const double value = to_key_unit(std::sqrt(rest));
    bars.push_back({phrase(Phrase::more_contributors, language,
                           {std::to_string(budget.lines.size() - kMostContributors)}),
                    value, share, value, "narrow"});
  }
  const double u = to_key_unit(budget.u);
  bars.push_back({phrase(Phrase::combined_u, language), u, 1, u, "ink-dot"});
  return bars;
}

std::string budget_line(const Budget& b) {
  const Key key = split_key(b.figure);
  const auto shown = [&](double u) { return uncertainty_text(to_key_unit(u)) + " " + key.unit; };
  return key.name + " = " + value_text(to_key_unit(b.value), to_key_unit(b.u)) + " " + key.unit +
         ", u = " + shown(b.u) + ", U = " + shown(b.U) +
         " (k = " + fixed_text(b.coverage_factor, 2) + ", 95 %" +
         (b.U_by_trials ? ", Monte Carlo" : "") + ")";
}

void draw_budget_bar(Svg& svg, const Panel& panel, const Bar& bar, const std::string& unit,
                     double top) {
  svg.data("contributor", bar.name).data("contribution", bar.contribution);
  svg.data("share", bar.share);
  svg.begin_group(bar.name);
  svg.text("text", {panel.corner.x - 8, top + kRowPx / 2 + 4}, Anchor::end,
           shortened(bar.name, kLongestContributor));
  if (std::isfinite(bar.value))
    svg.rect(bar.mark, {panel.px_x(0), top + (kRowPx - kThickPx) / 2},
             panel.px_x(bar.value) - panel.px_x(0), kThickPx);
  svg.text("text tick", {panel.corner.x + panel.width + kSharePx, top + kRowPx / 2 + 4},
           Anchor::end,
           number_text(bar.value, 2) + " " + unit + ", " + fixed_text(100 * bar.share, 1) + " %");
  svg.end_group();
}

}  // namespace

bool has_budget(const Budget& budget) {
  return budget.u > 0 && std::isfinite(budget.u) && !budget.lines.empty();
}

std::string budget_svg(const Budget& budget, const std::string& title_of,
                       const std::vector<std::string>& marks_of_run, Language language) {
  const std::vector<std::string> marks =
      with_noise_only_mark(budget.noise_only, marks_of_run, language);
  const std::vector<Bar> bars = contributor_bars(budget, language);
  const auto [name, unit] = split_key(budget.figure);
  const std::string title = title_of + ": " + phrase(Phrase::budget, language) + ", " + name;
  const std::string line = budget_line(budget);
  std::vector<std::string> notes = {
      phrase(Phrase::u_covers, language, {words::text(covers(budget), language)})};
  if (budget.is_imported && !budget.not_declared.empty()) {
    notes.emplace_back(phrase(Phrase::undeclared_at_import, language));
  } else if (!budget.not_declared.empty()) {
    std::string keys;
    for (const std::string& key : budget.not_declared) keys += (keys.empty() ? "" : ", ") + key;
    notes.push_back(phrase(Phrase::not_declared, language, {keys}));
  }
  const double top = run_head_height(marks) + kAboveBarsPx;
  const double height = kRowPx * static_cast<double>(bars.size());
  Svg svg(kWidthPx, top + height + kBelowBarsPx + notes_height(notes), title, line, Theme::light);
  draw_run_head(svg, title, line, marks, language);
  double room = 60;
  Range x;
  x.include(0);
  for (const Bar& bar : bars) {
    room = std::max(room, text_width(shortened(bar.name, kLongestContributor), kTextPx));
    x.include(bar.value * 1.02);
  }
  Panel panel;
  panel.corner = {kMarginPx + room + 10, top};
  panel.width = kWidthPx - kMarginPx - kSharePx - panel.corner.x;
  panel.height = height;
  panel.x = horizontal_axis(x, panel.width);
  const double bottom = top + height;
  svg.data("panel", budget.figure).data("value", to_key_unit(budget.value));
  svg.data("u", to_key_unit(budget.u)).data("U", to_key_unit(budget.U));
  svg.data("k", budget.coverage_factor);
  svg.begin_group();
  for (const Tick& tick : panel.x.ticks) {
    const double at = panel.px_x(tick.at);
    svg.line("grid", {at, top}, {at, bottom});
    svg.text("quiet tick", {at, bottom + 16}, Anchor::middle, tick.label);
  }
  svg.line("rule", {panel.px_x(0), top}, {panel.px_x(0), bottom});
  svg.text("quiet", {panel.corner.x + panel.width, bottom + 34}, Anchor::end,
           key_label(std::string(phrase(Phrase::contribution, language)) +
                         budget.figure.substr(budget.figure.rfind('_')),
                     panel.x.exponent));
  svg.text("quiet tick", {kWidthPx - kMarginPx, top - 8}, Anchor::end,
           phrase(Phrase::share_of_variance, language));
  for (std::size_t i = 0; i < bars.size(); ++i)
    draw_budget_bar(svg, panel, bars[i], unit, top + kRowPx * static_cast<double>(i));
  svg.end_group();
  draw_notes(svg, bottom + 44, notes);
  return svg.take();
}

}  // namespace mdof::charts
