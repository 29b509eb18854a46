// The budget of a machine as JSON and as text.
#pragma once

#include <string>

#include "tools/mdof/commands/machine/budget_found.h"

namespace mdof::tools {

std::string machine_budget_json(const Machine& machine, const BudgetRequest& request,
                                const FoundMachineBudget& found);
std::string machine_budget_text(const Machine& machine, const BudgetRequest& request,
                                const FoundMachineBudget& found);

}  // namespace mdof::tools
