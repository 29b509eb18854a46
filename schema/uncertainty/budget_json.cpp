#include "schema/uncertainty/budget_json.h"

#include <cmath>

#include "schema/axis.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof {
namespace {

void write_line(JsonWriter& json, const BudgetLine& line) {
  json.begin_object().field("contributor", contributor_text(line.name)).key("key");
  line.key.empty() ? json.null() : json.value(line.key);
  json.key("value");
  line.key.empty() ? json.null() : json.value(line.value);
  json.key("unit");
  line.key.empty() ? json.null() : json.value(line.unit);
  json.field("distribution", line.distribution).key("sensitivity");
  line.key.empty() ? json.null() : json.value(to_key_unit(line.contribution) / line.value);
  json.field("contribution", to_key_unit(line.contribution))
      .field("share", line.share)
      .field("dof", line.freedom)
      .end_object();
}

void write_trials(JsonWriter& json, const BudgetTrials& trials) {
  json.key("trials")
      .begin_object()
      .field("trials", trials.trials)
      .field("seed", trials.seed)
      .field("u", to_key_unit(trials.u))
      .field("low", to_key_unit(trials.low))
      .field("high", to_key_unit(trials.high))
      .end_object();
}

}  // namespace

void write_stated_members(JsonWriter& json, const Budget& budget) {
  json.field("value", to_key_unit(budget.value))
      .field("u", to_key_unit(budget.u))
      .field("u_random", to_key_unit(budget.u_random))
      .field("nu_eff", budget.freedom)
      .field("k", budget.coverage_factor)
      .field("U", to_key_unit(budget.U))
      .field("U_by", budget.U_by_trials ? "Monte Carlo" : "GUM");
}

void write_stated(JsonWriter& json, const StatedFigures& figures) {
  json.key("uncertainty").begin_object();
  for (const Budget& budget : figures.budgets) {
    json.key(budget.figure).begin_object();
    write_stated_members(json, budget);
    json.end_object();
  }
  json.end_object();
  if (!figures.why.empty()) json.field("uncertainty_reason", figures.why);
}

void write_covers(JsonWriter& json, const std::vector<Budget>& budgets) {
  write_covers(json, covers_text(budgets),
               budgets.empty() ? std::vector<std::string>() : budgets.front().not_declared);
}

void write_budgets(JsonWriter& json, const std::vector<Budget>& budgets,
                   const std::optional<Decision>& decision) {
  json.begin_object();
  for (const Budget& budget : budgets) {
    json.key(budget.figure).begin_object();
    write_stated_members(json, budget);
    json.field("noise_only", budget.noise_only).field("u_covers", covers_text(budget));
    json.key("not_declared").begin_array();
    for (const std::string& key : budget.not_declared) json.value(key);
    json.end_array();
    if (decision) write_decision(json, *decision);
    json.key("contributors").begin_array();
    for (const BudgetLine& line : budget.lines) write_line(json, line);
    json.end_array();
    if (budget.trials) write_trials(json, *budget.trials);
    json.end_object();
  }
  json.end_object();
}

}  // namespace mdof
