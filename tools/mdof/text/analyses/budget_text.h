// Uncertainty budgets as tables for people and as CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::tools {

// One row a figure: value, U, k, what is random, and the largest contributor.
std::string budgets_text(const std::vector<Budget>& budgets, std::size_t width);
// The figures of a run, or why they have no uncertainty.
std::string stated_figures_text(const StatedFigures& stated, std::size_t width);
// One figure whole, with a sentence that says what to improve first.
std::string budget_text(const Budget& budget, const std::optional<Decision>& decision,
                        std::size_t width);
// One row a figure and contributor.
std::string budgets_csv(const std::vector<Budget>& budgets);

// What these budgets leave out, as the rig does not declare it; "": nothing.
std::string not_declared_text(const std::vector<Budget>& budgets);

}  // namespace mdof::tools
