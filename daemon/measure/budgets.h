// Uncertainty budgets of stored runs, made when they are asked for: what is stored stays as it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/uncertainty/budget.h"
#include "daemon/measure/evaluation.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::daemon {

struct RunBudgetsRequest {
  std::int64_t run = 0;
  Reference reference = Reference::fixture;
  std::string figure;          // only this one, "EYX_straightness_um"; empty: all
  std::optional<double> at_m;  // instead: the errors at the target that is nearest to this position
  algo::TrialsRequest trials;
};
struct FoundBudgets {
  StatedAt stated;
  std::optional<double> at_m;  // the target that was taken
  std::vector<Budget> budgets;
  std::vector<std::string> warnings;  // of the runs
  bool simulated = false;
};
// Errors: no such run, one without errors, a figure that it does not have.
Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request);

// Of EC0Y, as fit_squareness() makes it; nothing is stored.
Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials);

}  // namespace mdof::daemon
