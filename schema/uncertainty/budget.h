// Uncertainty budget of one figure: GUM 5 and annex G, ISO 14253-1.
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

// SI (m, rad) unless the name states otherwise.
struct BudgetLine {
  ContributorName name;
  std::string key;  // key of the rig: "u_sensitivity_ppm"; empty: estimated from the run itself
  std::string distribution;  // "normal", "rectangular", ...
  double value = 0;          // the standard uncertainty, in `unit`
  std::string unit;          // "ppm"
  double contribution = 0;   // to u of the figure; signed if the sign is known
  double share = 0;          // contribution² / u², 0 ... 1
  double freedom = std::numeric_limits<double>::infinity();  // degrees of freedom
};

// Monte Carlo by JCGM 101: the figure of many runs, each with all contributors drawn from their
// distributions.
struct BudgetTrials {
  std::uint64_t trials = 0, seed = 0;
  double u = 0;
  double low = 0, high = 0;  // of the value: 2.5 % and 97.5 %
};

struct Budget {
  std::string figure;  // "EYX_straightness_um", with its unit
  double value = 0;
  double u = 0;                // combined standard uncertainty
  double u_random = 0;         // part of u: noise and repeatability, estimated from the run itself
  double freedom = 0;          // effective degrees of freedom, Welch-Satterthwaite (GUM G.4.1)
  double coverage_factor = 0;  // k for 95 %, Student's t
  double U = 0;                // k u
  bool U_by_trials = false;    // U is from the Monte Carlo trials, and k = U / u
  // The declarations of the rigs do not contribute to u, or less than 1 % of u. False if every key
  // is declared.
  bool noise_only = false;
  bool is_imported = false;  // from readings of another instrument, without a rig
  // No target was visited again: u does not include noise slower than a stop.
  bool is_single_run = false;
  // Keys that the rig does not declare; U does not include their contributions.
  std::vector<std::string> not_declared;
  std::vector<BudgetLine> lines;  // the largest first
  std::optional<BudgetTrials> trials;
};

// Budgets of the figures of a run; empty if omitted.
struct StatedFigures {
  std::vector<Budget> budgets;
  std::string why;  // why the budgets are omitted, a sentence without a full stop
};

// True if declared contributions are below a hundredth of u: they do not change two digits of u.
bool is_noise_only(double u, double u_declared);
// The same for the lines of a budget. False if every key is declared.
bool is_noise_only(const Budget& budget);

// Whether a line belongs to a key of the rig.
bool declares(const Budget& budget);

// Text for a u that contains noise only, used wherever this is stated.
inline constexpr const char* kNothingDeclared = "no uncertainties are declared";
// Contributions that u includes.
Covers covers(const Budget& budget);
// For several figures of the same rigs: the contributions of the most complete u.
Covers covers(const std::vector<Budget>& budgets);
// True if all are noise only; false if there are no budgets.
bool are_noise_only(const std::vector<Budget>& budgets);

// The budget of this figure; nullptr: none.
const Budget* find_budget(const std::vector<Budget>& budgets, std::string_view figure);

}  // namespace mdof
