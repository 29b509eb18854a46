// The uncertainty budget of one figure: GUM 5 and annex G, ISO 14253-1.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/uncertainty/contributor_name.h"
#include "schema/uncertainty/covers.h"

namespace mdof {

// SI (m, rad) but where the name says otherwise.
struct BudgetLine {
  ContributorName name;
  std::string key;           // of the rig: "u_sensitivity_ppm"; empty: seen in the run itself
  std::string distribution;  // "normal", "rectangular", ...
  double value = 0;          // the standard uncertainty, in `unit`
  std::string unit;          // "ppm"
  double contribution =
      0;             // to the standard uncertainty of the figure, of its sign where it has one
  double share = 0;  // contribution² / u², 0 ... 1
  double freedom = std::numeric_limits<double>::infinity();  // degrees of freedom
};

// By JCGM 101: the figure of many runs, each with all contributors drawn from their distributions.
struct BudgetTrials {
  std::uint64_t trials = 0, seed = 0;
  double u = 0;
  double low = 0, high = 0;  // of the value, 2.5 % and 97.5 %
};

struct Budget {
  std::string figure;  // "EYX_straightness_um", with its unit
  double value = 0;
  double u = 0;                // combined standard uncertainty
  double u_random = 0;         // of it: noise and repeatability, seen in the run itself
  double freedom = 0;          // effective degrees of freedom, Welch-Satterthwaite (GUM G.4.1)
  double coverage_factor = 0;  // k for 95 %, Student's t
  double U = 0;                // k u
  bool U_by_trials = false;    // U is that of Monte Carlo, and k = U / u
  // What rigs declare adds nothing to u: they declare nothing, or nothing that this figure shows.
  bool noise_only = false;
  bool is_imported = false;    // of readings of another instrument, with no rig
  bool is_single_run = false;  // no target was visited again: noise slower than a stop is not in u
  // Keys of the rig that are not declared: U is too small by what they would add.
  std::vector<std::string> not_declared;
  std::vector<BudgetLine> lines;  // the largest first
  std::optional<BudgetTrials> trials;
};

// Of the figures that a run has; none where they are left out.
struct StatedFigures {
  std::vector<Budget> budgets;
  std::string why;  // of being left out, a sentence without a full stop
};

// Nothing that rigs declare is seen in u: below a hundredth of it, u is the same in two digits.
bool is_noise_only(double u, double u_declared);
// The same of a budget's lines.
bool is_noise_only(const Budget& budget);

// A line of it is of a rig's key.
bool declares(const Budget& budget);

// Why a u has noise alone, wherever that is said.
inline constexpr const char* kNothingDeclared = "no uncertainties are declared";
// What its u is made of.
Covers covers(const Budget& budget);
// Of several figures of the same rigs: what that covers which covers most.
Covers covers(const std::vector<Budget>& budgets);
// Each of them; false of none at all.
bool are_noise_only(const std::vector<Budget>& budgets);

// The budget of this name; none: it is not among them.
const Budget* find_budget(const std::vector<Budget>& budgets, std::string_view figure);

}  // namespace mdof
