#include "schema/uncertainty/budget.h"

#include <algorithm>
#include <cmath>

namespace mdof {
bool is_noise_only(double u, double u_declared) {
  constexpr double kVisibleShare = 0.01;  // part of u
  return !(u_declared > kVisibleShare * u);
}

bool is_noise_only(const Budget& budget) {
  double square = 0;
  for (const BudgetLine& line : budget.lines)
    if (!line.key.empty()) square += line.contribution * line.contribution;
  return !budget.not_declared.empty() && is_noise_only(budget.u, std::sqrt(square));
}

bool declares(const Budget& budget) {
  return std::any_of(budget.lines.begin(), budget.lines.end(),
                     [](const BudgetLine& line) { return !line.key.empty(); });
}

Covers covers(const Budget& budget) {
  if (budget.is_imported)
    return {budget.not_declared.empty() && (budget.lines.empty() || declares(budget))
                ? Covered::repeatability_import
                : Covered::repeatability_only};
  return covers({.noise_only = budget.noise_only,
                 .declares = declares(budget),
                 .repeated = !budget.is_single_run});
}

Covers covers(const std::vector<Budget>& budgets) {
  const auto best = std::find_if(budgets.begin(), budgets.end(),
                                 [](const Budget& budget) { return !budget.noise_only; });
  if (budgets.empty()) return {};
  Covers found = covers(best == budgets.end() ? budgets.front() : *best);
  const auto has_import = [](const Budget& b) { return b.is_imported && declares(b); };
  const auto is_at_one_target = [](const Budget& b) {
    return b.is_imported && !b.lines.empty() && !declares(b);
  };
  if (std::any_of(budgets.begin(), budgets.end(), has_import)) {
    found = {Covered::repeatability_import};
    if (std::any_of(budgets.begin(), budgets.end(), is_at_one_target))
      found.push_back(Covered::one_target_repeatability_only);
  }
  const auto is_unknown = [](const Budget& b) { return b.is_imported && std::isnan(b.u); };
  if (std::any_of(budgets.begin(), budgets.end(), is_unknown))
    found.push_back(Covered::unknown_without_repeatability);
  return found;
}

bool are_noise_only(const std::vector<Budget>& budgets) {
  return !budgets.empty() && std::all_of(budgets.begin(), budgets.end(),
                                         [](const Budget& budget) { return budget.noise_only; });
}

const Budget* find_budget(const std::vector<Budget>& budgets, std::string_view figure) {
  const auto found = std::find_if(budgets.begin(), budgets.end(),
                                  [&](const Budget& budget) { return budget.figure == figure; });
  return found == budgets.end() ? nullptr : &*found;
}

}  // namespace mdof
