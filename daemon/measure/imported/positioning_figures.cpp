#include "daemon/measure/imported/positioning_figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/positioning/range_of_means.h"
#include "schema/imported/series.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using algo::MeanOfReadings;

// Standard uncertainty of the mean. NaN if all readings are equal: their scatter is then smaller
// than the resolution of the instrument, and the file does not state the resolution.
double u_random(const MeanOfReadings& mean) {
  const auto n = static_cast<double>(mean.n);
  return mean.squares == 0 ? kNaN : std::sqrt(mean.squares / (n - 1) / n);
}

std::vector<MeanOfReadings> means_of(const Run& run, int direction) {
  std::map<int, std::vector<double>> readings;
  for (const MeasuredPoint& p : run.points)
    if (p.point.direction == direction) readings[p.target].push_back(deviation(p));
  std::vector<MeanOfReadings> means;
  for (const auto& [target, values] : readings) {
    MeanOfReadings& mean = means.emplace_back(MeanOfReadings{target, 0, values.size(), 0});
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    for (const double v : values) mean.value += v / static_cast<double>(values.size());
    if (*low == *high) continue;
    for (const double v : values) mean.squares += (v - mean.value) * (v - mean.value);
  }
  return means;
}

// The declared standard uncertainty of a deviation. NaN: no uncertainty was declared. 0 is a
// declared uncertainty.
double declared_u(const Run& run) {
  double largest = kNaN;
  for (const MeasuredPoint& p : run.points) largest = std::fmax(largest, deviation_uncertainty(p));
  return largest;
}

void add_repeats(Budget& budget, ContributorKind kind, const MeanOfReadings& mean) {
  BudgetLine line;
  line.name = {kind};
  line.distribution = "t";
  line.contribution = u_random(mean);
  line.freedom = static_cast<double>(mean.n) - 1;
  budget.lines.push_back(line);
  budget.u_random = std::hypot(budget.u_random, line.contribution);
}

void add_declared(Budget& budget, ContributorKind kind, double u) {
  BudgetLine line;
  line.name = {kind};
  line.key = "u_um";
  line.unit = "um";
  line.value = to_um(u);
  line.distribution = "normal";
  line.contribution = u;
  budget.lines.push_back(line);
}

// A figure with the trials for its U.
struct Range {
  Budget budget;
  algo::RangeTrials trials;
};

Range range_of(const std::string& figure, const std::vector<MeanOfReadings>& means, double u) {
  const auto [low, high] = std::minmax_element(
      means.begin(), means.end(),
      [](const MeanOfReadings& a, const MeanOfReadings& b) { return a.value < b.value; });
  Budget budget;
  budget.figure = figure;
  budget.value = high->value - low->value;
  using enum ContributorKind;
  for (const auto& [end, of_repeats, of_import] :
       {std::tuple{high, upper_end_repeats, upper_end_declared},
        {low, lower_end_repeats, lower_end_declared}}) {
    add_repeats(budget, of_repeats, *end);
    if (u > 0 && high->target != low->target) add_declared(budget, of_import, u);
  }
  return {std::move(budget), algo::range_trials(means, u > 0 ? u : 0)};
}

// `forward` and `reverse` must have the same targets.
Range reversal_of(const std::string& figure, const std::vector<MeanOfReadings>& forward,
                  const std::vector<MeanOfReadings>& reverse) {
  std::size_t largest = 0;
  const auto size_at = [&](std::size_t i) { return std::abs(forward[i].value - reverse[i].value); };
  for (std::size_t i = 1; i < forward.size(); ++i)
    if (size_at(i) > size_at(largest)) largest = i;
  Budget budget;
  budget.figure = figure;
  budget.value = size_at(largest);
  add_repeats(budget, ContributorKind::forward_repeats, forward[largest]);
  add_repeats(budget, ContributorKind::reverse_repeats, reverse[largest]);
  return {std::move(budget), algo::reversal_trials(forward, reverse)};
}

Budget stated(Range of, bool is_declared) {
  Budget budget = std::move(of.budget);
  budget.is_imported = true;
  if (!is_declared) budget.not_declared = {"u_um"};
  if (!std::isnan(budget.u_random)) {
    algo::complete(budget);
    algo::state_interval(budget, of.trials);
    return budget;
  }
  budget.u = budget.U = budget.freedom = budget.coverage_factor = kNaN;
  budget.is_single_run = true;
  budget.lines.clear();
  return budget;
}

StatedFigures figures_of(const Run& run) {
  StatedFigures figures;
  const std::string name = positioning_name(run.header.axis);
  const double u = declared_u(run);
  const auto add = [&](Range of) {
    figures.budgets.push_back(stated(std::move(of), !std::isnan(u)));
  };
  const auto forward = means_of(run, 1), reverse = means_of(run, -1);
  std::map<int, int> approaches;  // number of approaches (1 or 2) of each target
  for (const auto* means : {&forward, &reverse})
    for (const MeanOfReadings& mean : *means) ++approaches[mean.target];
  if (forward.size() == approaches.size() && reverse.size() == approaches.size()) {
    std::vector<MeanOfReadings> both = forward;
    both.insert(both.end(), reverse.begin(), reverse.end());
    add(range_of(name + "_E_um", both, u));
    add(reversal_of(name + "_B_um", forward, reverse));
  } else {
    figures.why = "E and B of ISO 230-2 need readings from both approaches at each target";
  }
  if (forward.size() == approaches.size()) add(range_of(name + "_E_forward_um", forward, u));
  if (reverse.size() == approaches.size()) add(range_of(name + "_E_reverse_um", reverse, u));
  return figures;
}

}  // namespace

bool has_unknown_approach(const Run& run) {
  return std::any_of(run.points.begin(), run.points.end(),
                     [](const MeasuredPoint& p) { return p.point.direction == 0; });
}

StatedFigures positioning_range(const Run& run) {
  Run all = run;
  for (MeasuredPoint& p : all.points) p.point.direction = 0;
  const std::string figure = positioning_name(run.header.axis) + "_range_um";
  const double u = declared_u(run);
  return {{stated(range_of(figure, means_of(all, 0), u), !std::isnan(u))},
          "E and B of ISO 230-2 can be calculated only if the approach of each reading is known"};
}

StatedFigures positioning_figures(const Run& run) {
  if (run.header.provenance.model != positioning_name(run.header.axis))
    return {{}, "results according to ISO 230-2 are calculated only for positioning errors"};
  return has_unknown_approach(run) ? positioning_range(run) : figures_of(run);
}

}  // namespace mdof::daemon
