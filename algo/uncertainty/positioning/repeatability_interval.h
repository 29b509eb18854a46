// The expanded uncertainty of R of ISO 230-2. Noise makes the scatter of the visits larger; if the
// axis repeats perfectly, all of R is noise.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mdof::algo {

// Target and approach of each visit of an error: 2 i reverse, 2 i + 1 forward.
struct VisitGroups {
  std::vector<std::size_t> of_visit;
  std::size_t targets = 0;
};

enum class RepeatabilityKind { forward, reverse, both };
inline constexpr std::array kRepeatabilities = {
    RepeatabilityKind::forward, RepeatabilityKind::reverse, RepeatabilityKind::both};

// R forward, R reverse or R of these values of the visits; NaN if an approach has one visit.
double repeatability_R(const VisitGroups& groups, const double* values, RepeatabilityKind of);

// U such that 95 % of measured R lie within U of the true R, over trials of the errors of the
// measurement. R is a seminorm of the readings, so the true readings λ x (x measured) have the true
// value T = λ R, for λ from 0 to 1. U is found by inversion as in range_interval.h: U = R - T where
// R - T = c(T), the 95 % point of |R(λ x + errors) - T|; U = c(0) if c(0) is R or more. `errors`:
// trial after trial, one value for each visit.
double repeatability_U(const VisitGroups& groups, const std::vector<double>& measured,
                       const std::vector<double>& errors, RepeatabilityKind of);

}  // namespace mdof::algo
