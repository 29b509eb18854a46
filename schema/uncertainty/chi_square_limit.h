// Limit of χ² for residuals. If χ² is above this limit, the residuals are larger than the
// uncertainties explain.
#pragma once

namespace mdof {

// The value that χ² exceeds with a probability of 1e-6.
double chi_square_limit(int freedom);

}  // namespace mdof
