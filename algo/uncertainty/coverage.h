// Coverage factor of a combined standard uncertainty (GUM annex G).
#pragma once

#include <span>

namespace mdof::algo {

// Effective degrees of freedom by Welch-Satterthwaite (GUM G.2b): u⁴ / Σ (u_i⁴ / ν_i) with u² = Σ
// u_i² and the degrees of freedom ν_i of u_i. Infinite if all ν_i are infinite, if u is 0, or if
// the result is 1e7 or more, because k is then the k of the normal distribution.
struct UncertaintyPart {
  double u = 0, freedom = 0;
};
double effective_freedom(std::span<const UncertaintyPart> parts);
// The same, from the sum of u_i² and the sum of fourth_over_freedom(u_i², ν_i).
double effective_freedom(double sum_of_squares, double sum_of_fourths);
double fourth_over_freedom(double u_square, double freedom);  // u⁴ / ν

// k such that ±k u covers 95 % of Student's t distribution with `freedom` degrees of freedom (GUM
// G.3.2 and table G.2). The GUM truncates `freedom` to an integer; this function does not. k is
// 1.960 for infinite `freedom`.
double coverage_factor(double freedom);
// t such that 95 % of Student's t distribution lie below t. t is 1.645 for infinite `freedom`.
double one_sided_factor(double freedom);

}  // namespace mdof::algo
