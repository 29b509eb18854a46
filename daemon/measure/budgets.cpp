#include "daemon/measure/budgets.h"

#include <cmath>

#include "algo/sequence/usable_runs.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// The target whose mean position is nearest.
Result<algo::TargetMean> target_near(const algo::RunBudgets& run, double at_m) {
  const algo::TargetMean* nearest = nullptr;
  for (const auto& mean : run.means().targets)
    if (!nearest || std::abs(mean.position_m - at_m) < std::abs(nearest->position_m - at_m))
      nearest = &mean;
  if (nearest) return *nearest;
  return bad_input("the run has no target with errors, so that there is nothing to budget");
}

Result<std::vector<algo::Figure>> chosen_figures(Axis axis, const std::string& name) {
  std::vector<algo::Figure> all = algo::figures_of_run(axis);
  if (name.empty()) return all;
  std::string names;
  for (algo::Figure& figure : all) {
    if (figure.name == name) return std::vector{std::move(figure)};
    names += (names.empty() ? "" : ", ") + figure.name;
  }
  return fail(ErrorCode::usage,
              "\"" + name + "\" is no figure of a run of this axis; there are " + names);
}

}  // namespace

Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request) {
  MDOF_TRY(const Run run, run_stated_at(store, request.run, request.reference));
  MDOF_TRY(const Rig rig, rig_of(run.header));
  MDOF_TRY(const auto of_run, algo::RunBudgets::create(rig, run));
  FoundBudgets found{run.header.stated, {}, {}, run.header.warnings, run.header.simulated};
  MDOF_TRY(auto figures, chosen_figures(run.header.axis, request.figure));
  if (request.at_m) {
    MDOF_TRY(const auto target, target_near(of_run, *request.at_m));
    found.at_m = target.position_m;
    figures = algo::errors_at_target(run.header.axis, target.target);
  }
  for (const algo::Figure& figure : figures) {
    Budget budget = of_run.of(figure);
    if (!std::isfinite(budget.value)) {
      if (request.figure.empty()) continue;
      return bad_input("run " + std::to_string(request.run) + " has too few solved targets for " +
                       figure.name);
    }
    if (request.trials.trials > 1)
      budget.trials = algo::summary_of(of_run.draw(figure, request.trials), request.trials.seed);
    found.budgets.push_back(std::move(budget));
  }
  if (found.budgets.empty())
    return bad_input("run " + std::to_string(request.run) +
                     " has too few solved targets for any figure, so that there is nothing to "
                     "budget; see mdof show");
  return found;
}

Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials) {
  MDOF_TRY(const Run x, store.run(request.run_x));
  MDOF_TRY(const Run y, store.run(request.run_y));
  MDOF_TRY(const Rig rig_x, rig_of(x.header));
  MDOF_TRY(const Rig rig_y, rig_of(y.header));
  MDOF_TRY(const SquareArtefact artefact, algo::artefact_of(rig_x, rig_y, request.given));
  // Whatever keeps the two from having a squareness is told here.
  MDOF_TRY(const Squareness fitted, algo::squareness(x, y, artefact, request.partial));
  MDOF_TRY(Budget budget, algo::squareness_budget(rig_x, x, rig_y, y, artefact, trials));
  FoundBudgets found{kAtFixture, {}, {}, algo::inherited_warnings({&x, &y}), fitted.simulated};
  found.budgets.push_back(std::move(budget));
  return found;
}

}  // namespace mdof::daemon
