#include "algo/uncertainty/conformity/decision.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "algo/uncertainty/coverage.h"

namespace mdof::algo {
namespace {

// If the limit divided by u is at least this number, the probability that the true value lies
// beyond the other end of the tolerance is below 0.1 %.
constexpr double kOneSidedFrom = 2.4;

struct Guard {
  double factor = 0;
  std::string rule;
};

Guard guard_of(const Budget& budget, double limit) {
  const std::string standard = "ISO 14253-1:2017, 95 % conformance probability, ";
  if (budget.U_by_trials)
    return {budget.coverage_factor, standard + "guard band g = U, from Monte Carlo trials"};
  // One-sided also if |value| exceeds the limit, because the other end of the tolerance is then far
  // away.
  const bool one_end = limit >= kOneSidedFrom * budget.u || std::abs(budget.value) > limit;
  const double factor = one_end ? one_sided_factor(budget.freedom) : budget.coverage_factor;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f u", factor);
  return {factor, standard +
                      (one_end ? "one-sided"
                               : "two-sided, because u is large compared with the tolerance") +
                      ", guard band g = " + text.data()};
}

// "a, b and c"
std::string list_of(const std::vector<std::string>& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text += (i == 0 ? "" : i + 1 == keys.size() ? " and " : ", ") + keys[i];
  return text;
}

}  // namespace

Decision decision(const Budget& budget, double limit, const std::string& against) {
  if (!(budget.u > 0) || !std::isfinite(budget.u)) {
    Decision unknown;
    unknown.limit = limit;
    unknown.guard_factor = unknown.guard_band = std::nan("");
    unknown.rule = "ISO 14253-1:2017; no guard band can be calculated without u";
    unknown.reason = budget.u == 0 ? "u is 0, because no uncertainty was found or declared"
                                   : "the uncertainty is unknown";
    return unknown;
  }
  Guard guard = guard_of(budget, limit);
  Decision d;
  d.limit = limit;
  d.guard_factor = guard.factor;
  d.guard_band = guard.factor * budget.u;
  d.rule = std::move(guard.rule);
  const double size = std::abs(budget.value);
  if (!against.empty())
    d.reason = against;
  else if (!budget.not_declared.empty())
    d.reason = budget.is_imported
                   ? "U is incomplete: no uncertainty was declared at import"
                   : "U is incomplete: the rig does not declare " + list_of(budget.not_declared);
  else if (budget.is_single_run)
    d.reason =
        "U is incomplete: no target was approached twice from the same direction, so U does not "
        "include noise with periods longer than a stop";
  else if (size + d.guard_band <= limit)
    d.conformity = Conformity::conform;
  else if (size - d.guard_band > limit)
    d.conformity = Conformity::not_conform;
  else  // or the value is NaN
    d.reason = "the value is too close to the limit of the tolerance (within the guard band)";
  return d;
}

}  // namespace mdof::algo
