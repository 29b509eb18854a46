// The expanded uncertainty of the repeatability R of ISO 230-2. Noise makes the scatter of the
// visits larger. For an axis that repeats perfectly, R is noise only.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mdof::algo {

// Target and approach of each visit. of_visit is 2 i for a reverse visit of target i, and 2 i + 1
// for a forward visit.
struct VisitGroups {
  std::vector<std::size_t> of_visit;
  std::size_t targets = 0;
};

enum class RepeatabilityKind { forward, reverse, both };
inline constexpr std::array kRepeatabilities = {
    RepeatabilityKind::forward, RepeatabilityKind::reverse, RepeatabilityKind::both};

// Calculates R forward, R reverse, or R for both approaches. `values`: one for each visit. NaN if a
// target has only one visit with a necessary approach.
double repeatability_R(const VisitGroups& groups, const double* values, RepeatabilityKind of);

// 95 % of all measured R lie within U of the true R. The trials are random errors of the visits. U
// is calculated by inversion over the trials, as in range_interval.h. x are the measured values;
// the possible true values are λ x, for λ from 0 to 1. Their R is T = λ R.
//   c(T) = 95 % point of |R(λ x + errors) - T|
//   U = R - T for the T at which R - T = c(T), or c(0) if c(0) >= R
// `errors`: of all visits in the first trial, then in the next trial, and so on.
double repeatability_U(const VisitGroups& groups, const std::vector<double>& measured,
                       const std::vector<double>& errors, RepeatabilityKind of);

}  // namespace mdof::algo
