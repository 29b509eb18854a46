#include "daemon/measure/imported/positioning_figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "schema/imported/series.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// Mean of the readings of one target with one approach.
struct ReadingsMean {
  int target = 0;
  double value = 0, u_random = kNaN, freedom = 0;
};

// Standard uncertainty of the mean. NaN if all readings are equal: their scatter is then smaller
// than the resolution of the instrument, and the file does not state the resolution.
double u_of_mean(const std::vector<double>& readings, double mean) {
  const auto [low, high] = std::minmax_element(readings.begin(), readings.end());
  if (*low == *high) return kNaN;
  const auto n = static_cast<double>(readings.size());
  double square = 0;
  for (const double v : readings) square += (v - mean) * (v - mean);
  return std::sqrt(square / (n - 1) / n);
}

std::vector<ReadingsMean> means_of(const Run& run, int direction) {
  std::map<int, std::vector<double>> readings;
  for (const MeasuredPoint& p : run.points)
    if (p.point.direction == direction) readings[p.target].push_back(deviation(p));
  std::vector<ReadingsMean> means;
  for (const auto& [target, values] : readings) {
    const auto n = static_cast<double>(values.size());
    double sum = 0;
    for (const double v : values) sum += v;
    means.push_back({target, sum / n, u_of_mean(values, sum / n), n - 1});
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

void add_repeats(Budget& budget, ContributorKind kind, const ReadingsMean& mean) {
  BudgetLine line;
  line.name = {kind};
  line.distribution = "t";
  line.contribution = mean.u_random;
  line.freedom = mean.freedom;
  budget.lines.push_back(line);
  budget.u_random = std::hypot(budget.u_random, mean.u_random);
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

Budget range_of(const std::string& figure, const std::vector<ReadingsMean>& means, double u) {
  const auto [low, high] = std::minmax_element(
      means.begin(), means.end(),
      [](const ReadingsMean& a, const ReadingsMean& b) { return a.value < b.value; });
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
  return budget;
}

// `forward` and `reverse` must have the same targets.
Budget reversal_of(const std::string& figure, const std::vector<ReadingsMean>& forward,
                   const std::vector<ReadingsMean>& reverse) {
  std::size_t largest = 0;
  const auto size_at = [&](std::size_t i) { return std::abs(forward[i].value - reverse[i].value); };
  for (std::size_t i = 1; i < forward.size(); ++i)
    if (size_at(i) > size_at(largest)) largest = i;
  Budget budget;
  budget.figure = figure;
  budget.value = size_at(largest);
  add_repeats(budget, ContributorKind::forward_repeats, forward[largest]);
  add_repeats(budget, ContributorKind::reverse_repeats, reverse[largest]);
  return budget;
}

void complete_or_unknown(Budget& budget) {
  if (!std::isnan(budget.u_random)) return algo::complete(budget);
  budget.u = budget.U = budget.freedom = budget.coverage_factor = kNaN;
  budget.is_single_run = true;
  budget.lines.clear();
}

void add_figures(const Run& run, StatedFigures& stated) {
  const std::string name = positioning_name(run.header.axis);
  const double u = declared_u(run);
  const auto forward = means_of(run, 1), reverse = means_of(run, -1);
  std::map<int, int> approaches;  // number of approaches (1 or 2) of each target
  for (const auto* means : {&forward, &reverse})
    for (const ReadingsMean& mean : *means) ++approaches[mean.target];
  if (forward.size() == approaches.size() && reverse.size() == approaches.size()) {
    std::vector<ReadingsMean> both = forward;
    both.insert(both.end(), reverse.begin(), reverse.end());
    stated.budgets.push_back(range_of(name + "_E_um", both, u));
    stated.budgets.push_back(reversal_of(name + "_B_um", forward, reverse));
  } else {
    stated.why = "E and B of ISO 230-2 need readings from both approaches at each target";
  }
  if (forward.size() == approaches.size())
    stated.budgets.push_back(range_of(name + "_E_forward_um", forward, u));
  if (reverse.size() == approaches.size())
    stated.budgets.push_back(range_of(name + "_E_reverse_um", reverse, u));
}

StatedFigures complete(StatedFigures stated, const Run& run) {
  for (Budget& budget : stated.budgets) {
    budget.is_imported = true;
    if (std::isnan(declared_u(run))) budget.not_declared = {"u_um"};
    complete_or_unknown(budget);
  }
  return stated;
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
  return complete(
      {{range_of(figure, means_of(all, 0), declared_u(run))},
       "E and B of ISO 230-2 can be calculated only if the approach of each reading is known"},
      run);
}

StatedFigures positioning_figures(const Run& run) {
  if (run.header.provenance.model != positioning_name(run.header.axis))
    return {{}, "results according to ISO 230-2 are calculated only for positioning errors"};
  if (has_unknown_approach(run)) return positioning_range(run);
  StatedFigures stated;
  add_figures(run, stated);
  return complete(std::move(stated), run);
}

}  // namespace mdof::daemon
