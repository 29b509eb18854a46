// The uncertainty budget of one figure: GUM 5 and annex G, ISO 14253-1.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

// SI (m, rad) but where the name says otherwise.
struct BudgetLine {
  std::string name;          // "probe A: sensitivity"
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
  bool noise_only = false;     // the rig declares nothing
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

// What its u is made of: one sentence for people, without a full stop.
std::string covers_text(const Budget& budget);

// ISO 14253-1: what may be said of a figure that must be at most `limit` in size.
enum class Conformity { conform, not_conform, undecided };
const char* to_string(Conformity conformity);  // "conform", "not conform", "undecided"
Conformity conformity(const Budget& budget, double limit);

}  // namespace mdof
