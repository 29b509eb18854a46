// Limit above which residuals are larger than their uncertainties explain.
#pragma once

namespace mdof {

// The value that χ² exceeds with a probability of 1e-6.
double chi_square_limit(int freedom);

}  // namespace mdof
