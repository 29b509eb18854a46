// When residuals are more than their uncertainties explain.
#pragma once

namespace mdof {

// Value that χ² exceeds by chance once in a million times.
double chi_square_limit(int freedom);

}  // namespace mdof
