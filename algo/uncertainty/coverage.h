// From a combined standard uncertainty to an interval: GUM annex G.
#pragma once

#include <span>

namespace mdof::algo {

// Effective degrees of freedom, Welch-Satterthwaite (GUM G.2b): u⁴ / Σ (u_i⁴ / ν_i) with u² = Σ
// u_i². Infinite if all ν_i are infinite, if u is 0, or from 1e7 on, where k is that of the normal
// distribution.
struct UncertaintyPart {
  double u = 0, freedom = 0;
};
double effective_freedom(std::span<const UncertaintyPart> parts);
// The same from two sums: of u_i², and of fourth_over_freedom(u_i², ν_i).
double effective_freedom(double sum_of_squares, double sum_of_fourths);
double fourth_over_freedom(double u_square, double freedom);  // u⁴ / ν

// k such that ±k u covers 95 % of Student's t with `freedom` degrees of freedom (GUM G.3.2 and
// table G.2, which truncates them to the next lower integer; this function does not). For infinite
// freedom k is 1.960.
double coverage_factor(double freedom);
// t such that 95 % of this distribution lie below t. For infinite freedom t is 1.645.
double one_sided_factor(double freedom);

}  // namespace mdof::algo
