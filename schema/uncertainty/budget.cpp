#include "schema/uncertainty/budget.h"

#include <algorithm>
#include <cmath>

namespace mdof {
bool is_noise_only(double u, double u_declared) {
  constexpr double kSeen = 0.01;  // of u
  return !(u_declared > kSeen * u);
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

std::string covers_text(const Budget& budget) {
  const std::string slow =
      budget.is_single_run ? "; noise slower than a stop is not included (single run)" : "";
  if (!budget.noise_only) return "noise, repeatability and the declared uncertainties" + slow;
  return std::string("noise and repeatability only (") +
         (declares(budget) ? "the declared uncertainties contribute at most 1 % of u"
                           : kNothingDeclared) +
         ")" + slow;
}

std::string covers_text(const std::vector<Budget>& budgets) {
  const auto best = std::find_if(budgets.begin(), budgets.end(),
                                 [](const Budget& budget) { return !budget.noise_only; });
  return budgets.empty() ? "" : covers_text(best == budgets.end() ? budgets.front() : *best);
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
