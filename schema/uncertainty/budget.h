// Uncertainty budget of one figure (GUM 5 and annex G, ISO 14253-1).
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

// Values are in SI units (m, rad) if the name states no other unit.
struct BudgetLine {
  ContributorName name;
  std::string key;           // key of the rig: "u_sensitivity_ppm"; empty: estimated from the run
  std::string distribution;  // "normal", "rectangular", ...
  double value = 0;          // the standard uncertainty, in `unit`
  std::string unit;          // "ppm"
  double contribution = 0;   // contribution to u of the figure; it has a sign if the sign is known
  double share = 0;          // contribution² / u², 0 ... 1
  double freedom = std::numeric_limits<double>::infinity();  // degrees of freedom
};

// Monte Carlo calculation according to JCGM 101: in each trial, all contributors have random values
// from their distributions, and the figure is calculated.
struct BudgetTrials {
  std::uint64_t trials = 0, seed = 0;
  double u = 0;
  double low = 0, high = 0;  // limits of the value: 2.5 % and 97.5 %
};

struct Budget {
  std::string figure;  // "EYX_straightness_um", with its unit
  double value = 0;
  double u = 0;                // combined standard uncertainty
  double u_random = 0;         // part of u from noise and repeatability, estimated from the run
  double freedom = 0;          // effective degrees of freedom, Welch-Satterthwaite (GUM G.4.1)
  double coverage_factor = 0;  // k for 95 %, Student's t
  double U = 0;                // k u
  bool U_by_trials = false;    // true: U is from the Monte Carlo trials, and k = U / u
  bool u_by_trials = false;    // true: u is from the trials, too; `lines` then do not add up to u
  // True: the declarations of the rigs contribute nothing to u, or less than 1 %. Always false if
  // every key is declared.
  bool noise_only = false;
  bool is_imported = false;  // true: calculated from readings of another instrument, without a rig
  // True: no target was visited twice. u then does not include noise with periods longer than a
  // stop.
  bool is_single_run = false;
  // Keys that the rig does not declare; U does not include their contributions.
  std::vector<std::string> not_declared;
  std::vector<BudgetLine> lines;  // sorted by contribution, the largest first
  std::optional<BudgetTrials> trials;
};

// Budgets of the figures of a run; empty if they are not calculated.
struct StatedFigures {
  std::vector<Budget> budgets;
  std::string why;  // reason why there are no budgets: a sentence without a full stop
};

// True if the declared contributions are less than 1 % of u. Two significant digits of u then do
// not change.
bool is_noise_only(double u, double u_declared);
// As above, for the lines of a budget. False if every key is declared.
bool is_noise_only(const Budget& budget);

// Whether a line of the budget comes from a key of the rig.
bool declares(const Budget& budget);

// The text that is displayed if u contains noise only because nothing is declared.
inline constexpr const char* kNothingDeclared = "no uncertainties are declared";
// The contributions that u includes.
Covers covers(const Budget& budget);
// For several figures of the same rigs: covers() of the first budget that is not noise only, or of
// the first budget if all are noise only. Imported readings have statements of their own.
Covers covers(const std::vector<Budget>& budgets);
// True if all budgets are noise only; false if there are no budgets.
bool are_noise_only(const std::vector<Budget>& budgets);

// Returns the budget of this figure; nullptr: no budget has this figure.
const Budget* find_budget(const std::vector<Budget>& budgets, std::string_view figure);

}  // namespace mdof
