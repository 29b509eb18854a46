#include "tools/mdof/text/analyses/budget_text.h"

#include <algorithm>
#include <cmath>

#include "schema/axis.h"
#include "schema/sample.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kLeastShare = 0.001;  // the sum of smaller contributions is one line

bool in_micrometres(const Budget& budget) {
  return budget.figure.ends_with("_um");
}

std::string unit_of(const Budget& budget) {
  return in_micrometres(budget) ? "µm" : "µrad";
}

// Rounds the value to the second significant digit of `u` (GUM 7.2.6).
std::string rounded_to_u(const Budget& budget, double si, double u) {
  return in_micrometres(budget) ? um_to_place(si, u) : urad_to_place(si, u);
}
std::string shown(const Budget& budget, double si) {
  return rounded_to_u(budget, si, budget.U);
}
std::string shown_u(const Budget& budget, double u) {
  return rounded_to_u(budget, u, u);
}

std::string significant(double x) {
  if (x == 0 || !std::isfinite(x)) return fixed(x, 0);
  const int digits = 2 - static_cast<int>(std::floor(std::log10(std::abs(x))));
  return fixed(x, std::clamp(digits, 0, 9));
}

// The effective degrees of freedom as text. They are not rounded to an integer, because k was
// calculated from the exact value.
std::string freedom_text(double freedom) {
  const bool whole = freedom == std::round(freedom);
  return freedom < 1000 ? fixed(freedom, whole || freedom >= 100 ? 0 : 2) : "many";
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

std::string head_of(const Budget& b, std::size_t width) {
  return wrapped(b.figure.substr(0, b.figure.rfind('_')) + " = " + rounded_to_u(b, b.value, b.u) +
                     " ± " + shown_u(b, b.u) + " " + unit_of(b) +
                     (b.u_by_trials ? " by Monte Carlo" : "") + ", expanded U = " + shown(b, b.U) +
                     (b.U_by_trials ? " by Monte Carlo" : "") +
                     " (k = " + fixed(b.coverage_factor, 2) +
                     ", 95 %; effective degrees of freedom: " + freedom_text(b.freedom) + ")",
                 width, 2) +
         "\n";
}

// A sentence with the largest contribution, and with u without this contribution. U without it is
// not stated, because k would change. If the contributions do not add up to u, the sentence states
// this.
std::string improvement_text(const Budget& b, std::size_t width) {
  if (b.lines.empty() || !(b.u > 0)) return "";
  if (b.u_by_trials)
    return wrapped(
               "The deviations are not larger than their uncertainties. Therefore mdof calculates "
               "u by Monte Carlo. The contributions are calculated by first-order propagation, so "
               "they do not add up to u.",
               width) +
           "\n";
  const BudgetLine& first = b.lines.front();
  const double without = b.u * std::sqrt(std::max(0.0, 1 - first.share));
  return wrapped("Improve first: " + contributor_text(first.name) + ", " + percent(first.share) +
                     " of u². Without this contribution, u would be " + shown_u(b, without) + " " +
                     unit_of(b) + ".",
                 width) +
         "\n";
}

std::string decision_text(const Budget& b, const Decision& decision, std::size_t width) {
  return wrapped("Tolerance " + shown(b, decision.limit) + " " + unit_of(b) + ": " +
                     to_string(decision.conformity) +
                     (decision.reason.empty() ? "" : ": " + decision.reason) + " (" +
                     decision.rule +
                     (std::isnan(decision.guard_band)
                          ? ""
                          : " = " + shown(b, decision.guard_band) + " " + unit_of(b)) +
                     ")",
                 width) +
         "\n";
}

std::string trials_text(const Budget& b) {
  const BudgetTrials& t = *b.trials;
  return "Monte Carlo, " + std::to_string(t.trials) + " trials, seed " + std::to_string(t.seed) +
         ": u " + shown_u(b, t.u) + ", 95 % of the values from " + shown(b, t.low) + " to " +
         shown(b, t.high) + " " + unit_of(b) + "\n";
}

}  // namespace

namespace {

// The undeclared keys. A key that is missing in both rigs ("X u_um_per_h", "Y u_um_per_h") is
// listed once, without the axis.
std::vector<std::string> keys_named_once(const std::vector<std::string>& keys) {
  const auto has = [&](const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  std::vector<std::string> once;
  for (const std::string& key : keys) {
    const std::string bare = key.substr(std::min<std::size_t>(2, key.size()));
    const bool both = has("X " + bare) && has("Y " + bare);
    if (!both) once.push_back(key);
    if (both && key.starts_with("X ")) once.push_back(bare);
  }
  return once;
}

}  // namespace

std::string not_declared_text(const std::vector<Budget>& budgets) {
  const Budget& first = budgets.front();  // all budgets have the same rigs
  if (first.not_declared.empty()) return "";
  const bool only = are_noise_only(budgets);
  return std::string(!only ? "the rig does not declare all uncertainties"
                     : declares(first)
                         ? "noise only: the declared uncertainties contribute at most 1 % of u"
                         : std::string("noise only: ") + kNothingDeclared) +
         ", so U is too small. Not declared: " + joined(keys_named_once(first.not_declared));
}

std::string budgets_text(const std::vector<Budget>& budgets, std::size_t width) {
  TextTable table(
      {"figure", "value", "unit", "U", "k", "u random", "largest contributor", "share"});
  for (const Budget& b : budgets) {
    const BudgetLine* first = b.lines.empty() ? nullptr : &b.lines.front();  // null: u is unknown
    table.add({b.figure.substr(0, b.figure.rfind('_')),
               with_u(rounded_to_u(b, b.value, b.u), shown_u(b, b.u)), unit_of(b), shown(b, b.U),
               fixed(b.coverage_factor, 2), shown_u(b, b.u_random),
               first ? contributor_text(first->name) : "", first ? percent(first->share) : ""});
  }
  return table.text(width) +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(budgets) +
                     ". U is the expanded uncertainty (95 %).",
                 width) +
         "\n";
}

std::string stated_figures_text(const StatedFigures& stated, std::size_t width) {
  if (!stated.why.empty())
    return wrapped("Figures without uncertainty: " + stated.why + ".", width) + "\n";
  const std::string missing = not_declared_text(stated.budgets);
  return "mean of the measured approaches, with uncertainty (details: mdof budget)\n" +
         budgets_text(stated.budgets, width) +
         (missing.empty() ? "" : wrapped(missing, width) + "\n");
}

std::string budget_text(const Budget& b, const std::optional<Decision>& decision,
                        std::size_t width) {
  TextTable table({"contributor", "u", "unit", "distribution", "sensitivity",
                   "contribution/" + unit_of(b), "share", "degrees of freedom"});
  double rest = 0, rest_share = 0;
  std::size_t left_out = 0;
  for (const BudgetLine& line : b.lines) {
    if (line.share < kLeastShare && &line != &b.lines.front()) {
      rest += line.contribution * line.contribution;
      rest_share += line.share;
      ++left_out;
      continue;
    }
    const bool seen = line.key.empty();
    table.add({contributor_text(line.name), seen ? "" : significant(line.value), line.unit,
               line.distribution,
               seen ? "" : significant(to_key_unit(line.contribution) / line.value),
               shown_u(b, line.contribution), percent(line.share), freedom_text(line.freedom)});
  }
  if (left_out > 0)
    table.add({std::to_string(left_out) + " more", "", "", "", "", shown_u(b, std::sqrt(rest)),
               percent(rest_share), ""});
  std::string text = head_of(b, width) + "\n" + table.text(width) + "combined u " +
                     shown_u(b, b.u) + " " + unit_of(b) + "\n" + improvement_text(b, width);
  if (b.trials) text += trials_text(b);
  if (decision) text += decision_text(b, *decision, width);
  return text;
}

std::string budgets_csv(const std::vector<Budget>& budgets) {
  CsvText csv;
  csv.cells({"figure", "value", "u", "u_random", "nu_eff", "k", "U", "contributor", "key",
             "contributor_u", "unit", "distribution", "sensitivity", "contribution", "share", "dof",
             "u_covers", "not_declared"});
  csv.end_row();
  for (const Budget& b : budgets) {
    for (const BudgetLine& line : b.lines) {
      const bool seen = line.key.empty();
      const double contribution = to_key_unit(line.contribution);
      csv.cell(std::string_view(b.figure)).cell(to_key_unit(b.value)).cell(to_key_unit(b.u));
      csv.cell(to_key_unit(b.u_random)).cell(b.freedom).cell(b.coverage_factor);
      csv.cell(to_key_unit(b.U)).cells({contributor_text(line.name), line.key});
      csv.cell(seen ? kNaN : line.value).cells({line.unit, line.distribution});
      csv.cell(seen ? kNaN : contribution / line.value).cell(contribution).cell(line.share);
      csv.cell(line.freedom).cells({covers_text(b), joined(b.not_declared, " ")}).end_row();
    }
  }
  return csv.take();
}

}  // namespace mdof::tools
