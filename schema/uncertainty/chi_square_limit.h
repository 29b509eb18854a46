// Limit for residuals that their uncertainties do not explain.
#pragma once

namespace mdof {

// Value that χ² exceeds by chance with a probability of 1e-6.
double chi_square_limit(int freedom);

}  // namespace mdof
