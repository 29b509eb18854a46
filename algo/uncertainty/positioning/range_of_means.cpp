#include "algo/uncertainty/positioning/range_of_means.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "algo/uncertainty/budget/budget_draws.h"

namespace mdof::algo {
namespace {

constexpr std::uint64_t kTrials = 2000;  // the error of U is then 2 %

struct Scatter {
  double variance = 0, freedom = 0;  // of one reading
};

Scatter scatter_of(const std::vector<MeanOfReadings>& means) {
  Scatter scatter;
  double squares = 0;
  for (const MeanOfReadings& mean : means) {
    squares += mean.squares;
    scatter.freedom += static_cast<double>(mean.n) - 1;
  }
  if (scatter.freedom == 0) return {0, std::numeric_limits<double>::infinity()};
  scatter.variance = squares / scatter.freedom;
  return scatter;
}

// [mean][trial]
std::vector<std::vector<double>> drawn_changes(const std::vector<MeanOfReadings>& means,
                                               double u_target) {
  BlockOfDraws draws({1, 2}, 0, kTrials);
  const UnitQuantity normal(std::numeric_limits<double>::infinity());
  const Scatter scatter = scatter_of(means);
  const std::vector<double> for_freedom = draws.next(normal);
  std::map<int, std::vector<double>> of_target;
  std::vector<std::vector<double>> changes;
  for (const MeanOfReadings& mean : means) {
    const auto [at, is_new] = of_target.try_emplace(mean.target);
    if (is_new) at->second = draws.next(normal);
    const double u = std::sqrt(scatter.variance / static_cast<double>(mean.n));
    std::vector<double>& change = changes.emplace_back(draws.next(normal));
    for (std::size_t t = 0; t < change.size(); ++t)
      change[t] = u * student_factor(for_freedom[t], scatter.freedom) * change[t] +
                  u_target * at->second[t];
  }
  return changes;
}

}  // namespace

RangeTrials range_trials(const std::vector<MeanOfReadings>& means, double u_target) {
  std::vector<double> measured, changes;
  for (const MeanOfReadings& mean : means) measured.push_back(mean.value);
  const auto drawn = drawn_changes(means, u_target);
  for (std::size_t t = 0; t < kTrials; ++t)
    for (const std::vector<double>& change : drawn) changes.push_back(change[t]);
  return {std::move(measured), std::move(changes)};
}

// Half reversals with both signs. The range of these values is the largest absolute reversal.
RangeTrials reversal_trials(const std::vector<MeanOfReadings>& forward,
                            const std::vector<MeanOfReadings>& reverse) {
  std::vector<MeanOfReadings> means = forward;
  means.insert(means.end(), reverse.begin(), reverse.end());
  const std::size_t n = forward.size();
  const auto drawn = drawn_changes(means, 0);
  std::vector<double> measured, changes;
  for (std::size_t i = 0; i < n; ++i)
    for (const double sign : {0.5, -0.5})
      measured.push_back(sign * (forward[i].value - reverse[i].value));
  for (std::size_t t = 0; t < kTrials; ++t)
    for (std::size_t i = 0; i < n; ++i)
      for (const double sign : {0.5, -0.5})
        changes.push_back(sign * (drawn[i][t] - drawn[n + i][t]));
  return {std::move(measured), std::move(changes)};
}

}  // namespace mdof::algo
