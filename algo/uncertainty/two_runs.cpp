#include "algo/uncertainty/two_runs.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "algo/model/restate.h"
#include "algo/uncertainty/budget_draws.h"

namespace mdof::algo {
namespace {

// `factor`: what the figure has of the run's.
void add_run(Budget& budget, const Budget& of_run, const std::string& name, double factor) {
  for (const std::string& key : of_run.not_declared)
    budget.not_declared.push_back(name + " " + key);
  for (BudgetLine line : of_run.lines) {
    line.name = name + ", " + line.name;
    line.contribution *= factor;
    budget.lines.push_back(std::move(line));
  }
}

BudgetLine artefact_line(const SquareArtefact& artefact) {
  BudgetLine line;
  line.name = "angle of the square";
  line.key = "u_artefact_angle_urad";
  line.distribution = to_string(UncertaintyShape::normal);
  line.value = artefact.u_rad * 1e6;
  line.unit = "µrad";
  line.contribution = artefact.u_rad * (artefact.corner < 0 ? -1 : 1);
  return line;
}

}  // namespace

Result<Budget> squareness_budget(const Rig& rig_x, const Run& run_x, const Rig& rig_y,
                                 const Run& run_y, const SquareArtefact& artefact,
                                 const TrialsRequest& request) {
  MDOF_TRY(const RunBudgets along_x, RunBudgets::create(rig_x, restate(run_x, kAtFixture)));
  MDOF_TRY(const RunBudgets along_y, RunBudgets::create(rig_y, restate(run_y, kAtFixture)));
  const Figure slope_x = slope_figure(Axis::x, 0), slope_y = slope_figure(Axis::y, 0);
  const Budget x = along_x.of(slope_x), y = along_y.of(slope_y);
  Budget budget;
  budget.figure = "EC0Y_urad";
  budget.value = -y.value - x.value + artefact.corner * artefact.angle_error_rad;
  budget.u_random = std::hypot(x.u_random, y.u_random);
  add_run(budget, x, "X", -1);
  add_run(budget, y, "Y", -1);
  if (artefact.u_rad > 0)
    budget.lines.push_back(artefact_line(artefact));
  else
    budget.not_declared.emplace_back("u_artefact_angle_urad");
  complete(budget);
  if (request.trials < 2) return budget;
  std::vector<double> values = along_x.draw({slope_x}, request, 0).front();
  const std::vector<double> of_y = along_y.draw({slope_y}, request, 1).front();
  const std::vector<double> of_square = BlockOfDraws({request.seed, 2}, 0, request.trials)
                                            .next(OneU(std::numeric_limits<double>::infinity()));
  for (std::uint64_t t = 0; t < request.trials; ++t)
    values[t] = -values[t] - of_y[t] + artefact.corner * artefact.angle_error_rad +
                artefact.u_rad * of_square[t];
  budget.trials = summary_of(std::move(values), request.seed);
  return budget;
}

Result<std::array<Budget, 2>> parallelism_budgets(const Rig& rig_a, const Run& run_a,
                                                  const Rig& rig_b, const Run& run_b) {
  MDOF_TRY(const RunBudgets of_a, RunBudgets::create(rig_a, restate(run_a, kAtFixture)));
  MDOF_TRY(const RunBudgets of_b, RunBudgets::create(rig_b, restate(run_b, kAtFixture)));
  std::array<Budget, 2> budgets;
  for (std::size_t named = 0; named < budgets.size(); ++named) {
    const Figure slope = slope_figure(run_a.header.axis, named);
    const Budget a = of_a.of(slope), b = of_b.of(slope);
    Budget& budget = budgets[named];
    budget.figure = std::string(error_names(run_a.header.axis)[named].name) + "_parallelism_urad";
    budget.value = b.value - a.value;
    budget.u_random = std::hypot(a.u_random, b.u_random);
    add_run(budget, a, "A", -1);
    add_run(budget, b, "B", 1);
    complete(budget);
  }
  return budgets;
}

}  // namespace mdof::algo
