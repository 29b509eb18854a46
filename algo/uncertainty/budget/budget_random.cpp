// The contribution "noise and repeatability" of a figure, from the scatter of the visits and from
// the scatter of the runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/coverage.h"

namespace mdof::algo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

RunBudgets::Random RunBudgets::random_of_targets(const Figure& figure) const {
  const std::size_t targets = means_.targets.size();
  double square = 0, freedom = kInfinity;
  bool asked = false;                // true: a target with an effect on the figure was found
  std::optional<std::size_t> error;  // the error, if the figure depends on one error only
  std::vector<double> by_target(targets);
  MeanShifts together;
  MeanErrors means = means_;
  for (std::size_t i = 0; i < targets; ++i) {
    const Errors5& u = repeatability_.u[i];
    const double part = half_difference_at(figure, means, i, u);
    square += part * part;
    Errors5 scattered{};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      if (repeatability_.by_scatter[k]) scattered[k] = u[k];
    if (part != 0 && !std::exchange(asked, true) &&
        half_difference_at(figure, means, i, scattered) != 0) {
      freedom = repeatability_.freedom;
      error = only_error(figure, i);
    }
    if (error && u[*error] > 0) by_target[i] = part / u[*error];
    together.insert(together.end(), repeatability_.u_shift.begin(), repeatability_.u_shift.end());
  }
  const auto square_by = [&](const std::vector<std::vector<Errors5>>& parts) {
    double sum = 0;
    for (const std::vector<Errors5>& part : parts) {
      MeanShifts shifts;
      for (const Errors5& at_target : part)
        shifts.insert(shifts.end(), at_target.begin(), at_target.end());
      sum += std::pow(half_difference(figure, shifts), 2);
    }
    return sum;
  };
  const double independent = square, scatter_freedom = freedom;
  if (error && repeatability_.correlated[*error]) {
    const auto widened = repeatability_.correlated[*error]->of(by_target);
    const double more = square * (widened.square - 1);
    // The line of a removed drift already contains slow noise.
    square += more > 0 ? std::max(0.0, more - by_removed_drift(figure)) : more;
    freedom = widened.freedom;
  }
  const double of_targets = square;
  square += square_by(repeatability_.together);
  const double by_passes = square_by(repeatability_.of_passes);
  const double shift = std::abs(half_difference(figure, together));
  const auto parts = [&](double of_noise, double of_its_freedom) {
    return std::array<UncertaintyPart, 3>{{{std::sqrt(of_noise), of_its_freedom},
                                           {std::sqrt(by_passes), repeatability_.passes_freedom},
                                           {shift, repeatability_.shift_freedom}}};
  };
  const double more = of_targets - independent;
  const double u = std::sqrt(square + by_passes + shift * shift);
  const UncertaintyPart without{
      std::sqrt(std::max(0.0, u * u - more)),
      effective_freedom(parts(std::max(0.0, square - more), scatter_freedom))};
  return {u, effective_freedom(parts(square, freedom)), without, without.u > 0 ? u / without.u : 1};
}

// The error whose mean at target i has an effect on the figure. Empty if several errors or no error
// has an effect.
std::optional<std::size_t> RunBudgets::only_error(const Figure& figure, std::size_t i) const {
  std::optional<std::size_t> only;
  MeanErrors means = means_;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    Errors5 alone{};
    alone[k] = repeatability_.u[i][k];
    if (half_difference_at(figure, means, i, alone) == 0) continue;
    if (only) return std::nullopt;
    only = k;
  }
  return only;
}

RunBudgets::Random RunBudgets::random_of_runs(const Figure& figure) const {
  std::vector<double> values;
  for (const MeanErrors& run : runs_)
    if (run.targets.size() == means_.targets.size()) values.push_back(figure.of(run));
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return {0, kInfinity, {}};
  double mean = 0, square = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean);
  return {std::sqrt(square / (n - 1) / n), n - 1, {}};
}

// Variance of the figure by removed drifts. It includes slow noise, which also contributes to the
// scatter of the runs.
double RunBudgets::by_removed_drift(const Figure& figure) const {
  double square = 0;
  for (const Shifted& shifted : shifted_) {
    if (shifted.contributor.name.kind != ContributorKind::removed_drift) continue;
    for (const MeanShifts& part : shifted.parts)
      square += std::pow(half_difference(figure, part), 2);
  }
  return square;
}

RunBudgets::Random RunBudgets::random_of(const Figure& figure) const {
  const Random targets = random_of_targets(figure), runs = random_of_runs(figure);
  const double seen = targets.u * targets.u + by_removed_drift(figure);
  if (!(runs.u * runs.u > kRunsScatterMore * seen)) return targets;
  // The part of the variance that exceeds independent noise of the visits has the few degrees of
  // freedom of the runs. This applies also if correlated noise of the visits explains some of this
  // part.
  const double square = targets.u * targets.u + runs.u * runs.u - seen, u = std::sqrt(square);
  const UncertaintyPart& without = targets.independent;
  const std::array<UncertaintyPart, 2> both = {
      {without, {std::sqrt(std::max(0.0, square - without.u * without.u)), runs.freedom}}};
  return {u, effective_freedom(both), without, without.u > 0 ? u / without.u : 1};
}

}  // namespace mdof::algo
