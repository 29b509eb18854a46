// Uncertainty budgets as tables and as CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::tools {

// One row for each figure: value, U, k, the part of u from noise, and the largest contribution.
std::string budgets_text(const std::vector<Budget>& budgets, std::size_t width);
// The figures of a run, or the reason why they have no uncertainty.
std::string stated_figures_text(const StatedFigures& stated, std::size_t width);
// All contributions to one figure. A sentence states what the user should improve first.
std::string budget_text(const Budget& budget, const std::optional<Decision>& decision,
                        std::size_t width);
// One row for each contribution to each figure.
std::string budgets_csv(const std::vector<Budget>& budgets);

// States which undeclared uncertainties these budgets do not contain; empty: none is missing.
std::string not_declared_text(const std::vector<Budget>& budgets);

}  // namespace mdof::tools
