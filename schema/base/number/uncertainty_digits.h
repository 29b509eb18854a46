// Digits of a value and its uncertainty (GUM 7.2.6).
#pragma once

namespace mdof {

// Number of decimals for two significant digits of u after rounding: 0.0996 is 0.10. At most 9.
// Negative: u is rounded to tens, hundreds, ... u must be finite and greater than 0.
int uncertainty_decimals(double u);
// x rounded to tens (decimals = -1), hundreds (-2), ...; x itself if decimals >= 0.
double rounded_to_tens(double x, int decimals);

}  // namespace mdof
