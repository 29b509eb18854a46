#include "daemon/measure/budgets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/iso230/parallelism.h"
#include "algo/separation/square_reversal.h"
#include "algo/sequence/usable_runs.h"
#include "algo/uncertainty/budget/two_runs.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "algo/uncertainty/stated.h"
#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/base/number/number_text.h"
#include "schema/iso230/iso230_json.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// Limit of RunBudgets::cost(). A calculation with this cost takes about one second. The cost of a
// run with 11 targets whose rig declares all uncertainties is 2,000.
constexpr std::size_t kMostCost = 250'000;

// The target whose mean position is nearest to at_m. Error: at_m is outside the range of the
// targets by more than half of the largest interval between targets.
Result<algo::TargetMean> target_near(const algo::RunBudgets& run, std::int64_t id, double at_m) {
  const auto& targets = run.means().targets;  // positions ascend
  if (targets.empty())
    return bad_input("no budget can be calculated, because no target of the run has error values",
                     Remedy::show_points);
  double interval_m = 0;
  const algo::TargetMean* nearest = &targets.front();
  for (std::size_t i = 1; i < targets.size(); ++i) {
    interval_m = std::max(interval_m, targets[i].position_m - targets[i - 1].position_m);
    if (std::abs(targets[i].position_m - at_m) < std::abs(nearest->position_m - at_m))
      nearest = &targets[i];
  }
  const double first_m = targets.front().position_m, last_m = targets.back().position_m;
  if (at_m >= first_m - interval_m / 2 && at_m <= last_m + interval_m / 2) return *nearest;
  return bad_input(plain_number(to_mm(at_m)) + " mm is outside the range of the targets of run " +
                   std::to_string(id) + " (" + plain_number(to_mm(first_m)) + " to " +
                   plain_number(to_mm(last_m)) + " mm); give a position within this range");
}

Result<std::vector<algo::Figure>> chosen_figures(std::vector<algo::Figure> all,
                                                 const std::string& name) {
  if (name.empty()) return all;
  std::string names;
  for (algo::Figure& figure : all) {
    if (figure.name == name) return std::vector{std::move(figure)};
    names += (names.empty() ? "" : ", ") + figure.name;
  }
  return fail(ErrorCode::usage, "figure \"" + name + "\" is unknown; give one of: " + names);
}

// The uncertainty (noise only) of a run whose rig cannot be read, with the reason.
RunUncertainty noise_of(const Run& run, const Error& error) {
  Rig nothing_declared;
  nothing_declared.axis = run.header.axis;
  RunUncertainty noise = algo::run_uncertainty(nothing_declared, run);
  noise.why = words::text(error);
  return noise;
}

StatedFigures stated_figures(const Run& run, const Result<algo::RunBudgets>& of_run) {
  if (!of_run) return {{}, words::text(of_run.error())};
  if (const Status quick = check_cost(*of_run); !quick) return {{}, words::text(quick.error())};
  StatedFigures stated{of_run->of(algo::figures_of_run(run.header.axis)), ""};
  std::erase_if(stated.budgets, [](const Budget& budget) { return !std::isfinite(budget.value); });
  if (stated.budgets.empty())
    stated.why =
        "no result could be calculated, because too few targets of the run have error values";
  return stated;
}

}  // namespace

Status check_cost(const algo::RunBudgets& budgets) {
  if (budgets.cost() <= kMostCost) return {};
  return bad_input("the uncertainty was not calculated: with " +
                       std::to_string(budgets.means().targets.size()) +
                       " targets and the declared uncertainties of the rig, the calculation would "
                       "take more than 1 s",
                   Remedy::budget_run);
}

RunUncertainty uncertainty_of(const Run& run) {
  const auto rig = rig_of(run.header);
  return rig ? algo::run_uncertainty(*rig, run) : noise_of(run, rig.error());
}

RunUncertainty stop_uncertainty(const Run& part) {
  const auto rig = rig_of(part.header);
  return rig ? algo::stop_uncertainty(*rig, part) : noise_of(part, rig.error());
}

StatedFigures figure_budgets(const Run& run) {
  const auto rig = rig_of(run.header);
  return rig ? stated_figures(run, algo::RunBudgets::create(*rig, run))
             : StatedFigures{{}, words::text(rig.error())};
}

StatedRun stated_run(const Run& run) {
  const auto rig = rig_of(run.header);
  if (!rig) return {noise_of(run, rig.error()), {{}, words::text(rig.error())}};
  algo::StatedUncertainty stated = algo::stated_uncertainty(*rig, run);
  return {std::move(stated.points), stated_figures(run, stated.figures)};
}

Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request) {
  MDOF_TRY(const Run run, restated_run(store, request.run, request.reference));
  MDOF_TRY(const Rig rig, rig_of(run.header));
  MDOF_TRY(const auto of_run, algo::RunBudgets::create(rig, run));
  FoundBudgets found{run.header.stated, {}, {}, run.header.notices, run.header.simulated};
  std::vector<algo::Figure> all = algo::figures_of_run(run.header.axis);
  if (request.at_m) {
    MDOF_TRY(const auto target, target_near(of_run, request.run, *request.at_m));
    found.at_m = target.position_m;
    all = algo::errors_at_target(run.header.axis, target.target);
  }
  MDOF_TRY(const auto figures, chosen_figures(std::move(all), request.figure));
  std::vector<Budget> budgets = of_run.of(figures);
  for (std::size_t f = 0; f < figures.size(); ++f) {
    if (!std::isfinite(budgets[f].value)) {
      if (request.figure.empty()) continue;
      return bad_input("run " + std::to_string(request.run) + ": " + figures[f].name +
                           " has no value, because too few targets of the run have error values",
                       Remedy::show_points);
    }
    if (request.trials.trials > 1) budgets[f].trials = of_run.trials(figures[f], request.trials);
    found.budgets.push_back(std::move(budgets[f]));
  }
  if (found.budgets.empty())
    return bad_input(
        "run " + std::to_string(request.run) +
            ": no budget can be calculated, because too few targets of the run have error values",
        Remedy::show_points);
  return found;
}

Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials) {
  MDOF_TRY(const SquarenessRuns of, squareness_runs(store, request));
  MDOF_TRY(Budget budget,
           algo::squareness_budget(of.rig_a, of.a, of.rig_b, of.b, of.fitted.artefact, trials));
  FoundBudgets found{
      kAtFixture, {}, {}, algo::inherited_notices({&of.a, &of.b}), of.fitted.simulated};
  found.budgets.push_back(std::move(budget));
  return found;
}

namespace {

// Calculates the squareness of one set-up under the assumption that the square has no angle error.
Result<algo::SquareSetUp> square_set_up(const SquarenessRuns& of) {
  MDOF_TRY(Budget budget,
           algo::squareness_budget(of.rig_a, of.a, of.rig_b, of.b, of.fitted.artefact));
  return algo::SquareSetUp{of.fitted.artefact.corner, std::move(budget)};
}

// The slopes of a curved axis over two travels differ, and the difference would count as the angle
// of the square.
Status cut_to_common_travel(Run& one, Run& other) {
  MDOF_TRY(algo::CommonTravel common, algo::over_common_travel(one, other));
  one = std::move(common.a);
  other = std::move(common.b);
  return {};
}

}  // namespace

Result<FoundSquareReversal> square_reversal(store::Store& store, SquarenessRequest first,
                                            SquarenessRequest second) {
  first.given = second.given = {0.0, 0.0};
  MDOF_TRY(SquarenessRuns a, squareness_runs(store, first));
  MDOF_TRY(SquarenessRuns b, squareness_runs(store, second));
  const algo::Runs runs{&a.a, &a.b, &b.a, &b.b};
  // squareness_runs() has already checked whether each run is complete.
  MDOF_CHECK(algo::check_usable(runs, true, "a separation"));
  MDOF_CHECK(cut_to_common_travel(a.a, b.a));
  MDOF_CHECK(cut_to_common_travel(a.b, b.b));
  MDOF_TRY(algo::SquareSetUp one, square_set_up(a));
  MDOF_TRY(algo::SquareSetUp other, square_set_up(b));
  MDOF_TRY(const SquareReversal found, algo::square_reversal(one, other));
  FoundSquareReversal out{found, std::move(one.budget.not_declared), algo::inherited_notices(runs),
                          a.fitted.simulated};
  append_new(out.not_declared, std::move(other.budget.not_declared));
  append(out.notices, algo::square_notices(found, {&a.rig_a, &a.rig_b, &b.rig_a, &b.rig_b}));
  return out;
}

Result<FoundParallelism> find_parallelism(store::Store& store, const ParallelismRequest& request) {
  MDOF_TRY(const Run a, store.run(request.run_a));
  MDOF_TRY(const Run b, store.run(request.run_b));
  MDOF_TRY(Parallelism found, algo::parallelism(a, b, request.partial));
  MDOF_TRY(const Rig rig_a, rig_of(a.header));
  MDOF_TRY(const Rig rig_b, rig_of(b.header));
  MDOF_TRY(const algo::CommonTravel common, algo::over_common_travel(a, b));
  MDOF_TRY(auto budgets, algo::parallelism_budgets(rig_a, common.a, rig_b, common.b));
  for (std::size_t i = 0; i < found.planes.size(); ++i)
    found.planes[i].budget = std::move(budgets[i]);
  return FoundParallelism{std::move(found), algo::inherited_notices({&a, &b})};
}

std::string parallelism_json(const FoundParallelism& found) {
  const Parallelism& p = found.parallelism;
  JsonWriter json;
  json.begin_object();
  json.field("axis", std::string(1, letter(p.axis)))
      .field("run_a", p.run_a)
      .field("run_b", p.run_b);
  write_reference(json, kAtFixture);
  json.field("from_mm", to_mm(p.from_m)).field("to_mm", to_mm(p.to_m));
  json.field("simulated", p.simulated);
  write_parallelism(json, p);
  std::vector<Budget> budgets;
  for (const ParallelismOfPlane& plane : p.planes) budgets.push_back(plane.budget);
  write_covers(json, budgets);
  json.key("figures");
  write_budgets(json, budgets);
  write_notices(json, "notices", found.notices, words::text);
  json.end_object();
  return json.take();
}

std::string budgets_json(const FoundBudgets& found, const std::optional<Decision>& decision) {
  JsonWriter json;
  json.begin_object();
  write_reference(json, found.stated);
  json.key("at_mm");
  found.at_m ? json.value(to_mm(*found.at_m)) : json.null();
  json.field("coverage", 0.95).field("simulated", found.simulated);
  write_covers(json, found.budgets);
  json.key("figures");
  write_budgets(json, found.budgets, decision);
  write_notices(json, "notices", found.notices, words::text);
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
