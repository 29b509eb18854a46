#include "algo/uncertainty/budget/two_runs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algo/iso230/square_tilt.h"
#include "algo/model/restate.h"
#include "algo/uncertainty/budget/budget_draws.h"
#include "algo/uncertainty/statistics/common_quantities.h"

namespace mdof::algo {
namespace {

// Budget of a figure that is factor_a * slope_a + factor_b * slope_b, for two runs a and b.
class TwoSlopes {
 public:
  struct Of {
    std::string name;  // "X"
    const RunBudgets& run;
    Figure slope;
    double factor;
  };
  TwoSlopes(const Of& a, const Of& b) {
    for (const Of* of : {&a, &b}) {
      const Budget budget = of->run.first_order(of->slope);
      budget_.value += of->factor * budget.value;
      budget_.u_random = std::hypot(budget_.u_random, budget.u_random);
      budget_.is_single_run = budget_.is_single_run || budget.is_single_run;
      for (const std::string& key : budget.not_declared)
        budget_.not_declared.push_back(of->name + " " + key);
      for (const BudgetLine& line : budget.lines)
        if (line.key.empty()) add(*of, line, {1, UncertaintyShape::normal, line.freedom});
    }
    add_contributions(a, b);
  }
  // The budget of all contributions that were added.
  Budget take() {
    complete(budget_);
    return std::move(budget_);
  }
  Budget& budget() { return budget_; }
  // Slopes are linear in the shifts of the means. Therefore the value of a trial is the figure plus
  // the sum of contribution times drawn number over all lines.
  std::vector<double> trials(const TrialsRequest& request) const {
    std::vector<double> values(request.trials, budget_.value);
    BlockOfDraws draws({request.seed, 0}, 0, request.trials);
    for (std::size_t i = 0; i < budget_.lines.size(); ++i) {
      const std::vector<double> drawn = draws.next(UnitQuantity(drawn_[i]));
      for (std::size_t t = 0; t < values.size(); ++t)
        values[t] += budget_.lines[i].contribution * drawn[t];
    }
    return values;
  }
  void add(BudgetLine line, const DeclaredUncertainty& drawn) {
    budget_.lines.push_back(std::move(line));
    drawn_.push_back({1, drawn.shape, drawn.freedom});
  }

 private:
  void add(const Of& of, BudgetLine line, const DeclaredUncertainty& drawn) {
    line.name.runs = {of.name};
    line.contribution *= of.factor;
    add(std::move(line), drawn);
  }
  // If a contributor has several parts, their sum is drawn from the normal distribution.
  static DeclaredUncertainty drawn_as(const RunBudgets::Contribution& of) {
    return of.parts.size() == 1 ? of.contributor->declared : DeclaredUncertainty{1};
  }

  // Adds the contributions of both runs. If a contributor is common to both runs, its two
  // contributions are added with their signs in one line.
  void add_contributions(const Of& a, const Of& b) {
    const auto of_a = a.run.contributions(a.slope), of_b = b.run.contributions(b.slope);
    std::vector<bool> added(of_b.size(), false);
    for (const auto& one : of_a) {
      const auto same = std::find_if(of_b.begin(), of_b.end(), [&](const auto& other) {
        return !one.contributor->common_as.empty() &&
               one.contributor->common_as == other.contributor->common_as &&
               one.parts.size() == other.parts.size();
      });
      if (same == of_b.end()) {
        add(a, RunBudgets::line(*one.contributor, one.parts), drawn_as(one));
        continue;
      }
      added[static_cast<std::size_t>(same - of_b.begin())] = true;
      std::vector<double> parts;
      for (std::size_t p = 0; p < one.parts.size(); ++p)
        parts.push_back(a.factor * one.parts[p] + b.factor * same->parts[p]);
      BudgetLine line = RunBudgets::line(*one.contributor, parts);
      line.name.runs = {a.name, b.name};
      line.value = std::max(line.value, RunBudgets::line(*same->contributor, {}).value);
      add(std::move(line), drawn_as(one));
    }
    for (std::size_t i = 0; i < of_b.size(); ++i)
      if (!added[i])
        add(b, RunBudgets::line(*of_b[i].contributor, of_b[i].parts), drawn_as(of_b[i]));
  }

  Budget budget_;
  std::vector<DeclaredUncertainty> drawn_;  // distribution of each line, with u = 1
};

BudgetLine artefact_line(const SquareArtefact& artefact, int sign) {
  BudgetLine line;
  line.name = {ContributorKind::artefact_angle};
  line.key = "u_artefact_angle_urad";
  line.distribution = to_string(UncertaintyShape::normal);
  const double u_rad = artefact.u_rad.value_or(0);
  line.value = u_rad * 1e6;
  line.unit = "µrad";
  line.contribution = u_rad * (artefact.corner < 0 ? -sign : sign);
  return line;
}

struct TwoRuns {
  RunBudgets a, b;
};

Figure slope_along(Axis of, Axis along) {
  return slope_figure(of, straightness_along(of, along));
}

Budget squareness_budget(AxisPair axes, const TwoRuns& runs, double tilt_rad,
                         const SquareArtefact& artefact, const TrialsRequest& request) {
  const int sign = squareness_sign(axes);
  const double factor = -sign;
  TwoSlopes both({std::string(1, letter(axes.a)), runs.a, slope_along(axes.a, axes.b), factor},
                 {std::string(1, letter(axes.b)), runs.b, slope_along(axes.b, axes.a), factor});
  both.budget().figure = std::string(squareness_name(axes)) + "_urad";
  both.budget().value += sign * artefact.corner * artefact.angle_error_rad + tilt_rad;
  if (artefact.u_rad.value_or(0) > 0)
    both.add(artefact_line(artefact, sign), {1});
  else if (!artefact.u_rad)
    both.budget().not_declared.emplace_back("u_artefact_angle_urad");
  std::vector<double> values;
  if (request.trials >= 2) values = both.trials(request);
  Budget budget = both.take();
  if (!values.empty()) budget.trials = summary_of(std::move(values), request.seed);
  return budget;
}

Result<TwoRuns> two_runs(const Rig& rig_a, const Run& run_a, const Rig& rig_b, const Run& run_b,
                         const StatedPair& at = {}) {
  const Run at_a = restate(run_a, at.a), at_b = restate(run_b, at.b);
  MDOF_TRY(auto of_a, contributors(rig_a, at_a));
  MDOF_TRY(auto of_b, contributors(rig_b, at_b));
  const TwoRunParts parts = parts_of_both_runs(of_a, rig_a.axis, of_b, rig_b.axis);
  TwoRuns both{{rig_a, at_a}, {rig_b, at_b}};
  for (std::size_t i = 0; i < of_a.size(); ++i) both.a.add(of_a[i], parts.a[i]);
  for (std::size_t i = 0; i < of_b.size(); ++i) both.b.add(of_b[i], parts.b[i]);
  return both;
}

}  // namespace

Result<Budget> squareness_budget(const Rig& rig_a, const Run& run_a, const Rig& rig_b,
                                 const Run& run_b, const SquareArtefact& artefact,
                                 const TrialsRequest& request) {
  MDOF_TRY(const TwoRuns runs, two_runs(rig_a, run_a, rig_b, run_b));
  const AxisPair axes{rig_a.axis, rig_b.axis};
  return squareness_budget(axes, runs, square_tilt_rad(run_a, run_b, axes), artefact, request);
}

Result<std::array<Budget, 3>> squareness_and_slope_budgets(const Rig& rig_a, const Run& run_a,
                                                           const Rig& rig_b, const Run& run_b,
                                                           const SquareArtefact& artefact,
                                                           const StatedPair& at) {
  MDOF_TRY(const TwoRuns runs, two_runs(rig_a, run_a, rig_b, run_b, at));
  const AxisPair axes{rig_a.axis, rig_b.axis};
  const double tilt_rad = square_tilt_rad(run_a, run_b, axes);
  return std::array{squareness_budget(axes, runs, tilt_rad, artefact, {}),
                    runs.a.of(slope_along(axes.a, axes.b)), runs.b.of(slope_along(axes.b, axes.a))};
}

Result<std::array<Budget, 2>> parallelism_budgets(const Rig& rig_a, const Run& run_a,
                                                  const Rig& rig_b, const Run& run_b) {
  MDOF_TRY(const TwoRuns runs, two_runs(rig_a, run_a, rig_b, run_b));
  std::array<Budget, 2> budgets;
  for (std::size_t named = 0; named < budgets.size(); ++named) {
    const Figure slope = slope_figure(run_a.header.axis, named);
    TwoSlopes both({"A", runs.a, slope, -1}, {"B", runs.b, slope, 1});
    both.budget().figure =
        std::string(error_names(run_a.header.axis)[named].name) + "_parallelism_urad";
    budgets[named] = both.take();
  }
  return budgets;
}

}  // namespace mdof::algo
